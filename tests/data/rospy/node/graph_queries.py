import rosgraph
import rosnode
import rosparam
import rospy
import rosservice
import rostopic
from geometry_msgs.msg import Twist
from std_msgs.msg import String
from std_srvs.srv import SetBool
from wait import said

rospy.init_node("tester")
publisher = rospy.Publisher("/queried/cmd", Twist, queue_size=1)
subscriber = rospy.Subscriber("/queried/in", String, lambda message: None)
service = rospy.Service("/queried/add", SetBool, lambda request: (request.data, "m"))
print([pair for pair in rospy.get_published_topics("/queried")], rospy.get_published_topics("/none"))
print(
    rostopic.get_topic_type("/queried/cmd")[:2],
    rostopic.get_topic_type("/none"),
    rostopic.get_topic_class("/queried/in")[0].__name__,
)
kind, name, evaluate = rostopic.get_topic_type("/queried/cmd/linear/x")
print(
    kind,
    name,
    evaluate(Twist()),
    [topic for topic in rostopic.find_by_type("geometry_msgs/Twist") if "queried" in topic],
)
print(
    "/tester" in rosnode.get_node_names(),
    rosnode.get_node_names("/nowhere"),
    rosnode.rosnode_ping("/tester", max_count=1),
)
print(
    rosservice.get_service_type("/queried/add"),
    rosservice.get_service_type("/none"),
    rosservice.get_service_node("/queried/add"),
)
print(rosservice.get_service_list(namespace="/queried"), rosservice.get_service_args("/queried/add"))
print(rosservice.get_service_class_by_name("/queried/add").__name__, rosservice.rosservice_find("std_srvs/SetBool"))
rosparam.upload_params("/queried", {"a": 1, "b": {"c": "x"}})
print(
    rosparam.list_params("/queried"),
    rosparam.get_param("/queried/b/c"),
    rosparam.load_str("a: 1\nb: [1, 2]", "f", "/ns"),
)
print(rosparam.load_str("x: deg(180)\n_ns: sub\ny: !degrees 90", "f"), said(rosparam.load_file, "/nowhere.yaml"))
master = rosgraph.Master("/other")
print(
    master.lookupNode("/tester") == rospy.get_node_uri(),
    said(master.lookupNode, "/none"),
    said(master.getParam, "/none"),
)
print(
    [each for each in master.getSystemState()[0] if "queried" in each[0]],
    master.is_online(),
    rosgraph.is_master_online(),
)
print(
    sorted(each for each in master.getTopicTypes() if "queried" in each[0]),
    master.hasParam("/queried"),
    master.caller_id,
)
rosparam.delete_param("/queried")
print(said(rosgraph.Master, "/x", "nonsense"))
