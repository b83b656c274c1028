import rosgraph
import rospy
from std_msgs.msg import String
from wait import until

try:
    from xmlrpc.client import ServerProxy
except ImportError:
    from xmlrpclib import ServerProxy

rospy.init_node("tester")
publisher = rospy.Publisher("called", String, queue_size=1)
subscriber = rospy.Subscriber("called", String, lambda message: None)
until(lambda: publisher.get_num_connections() == 1)
node = ServerProxy(rospy.get_node_uri())
print(node.getPid("/x")[0], node.getMasterUri("/x")[2].rstrip("/") == rosgraph.get_master_uri().rstrip("/"))
print(
    [each for each in node.getPublications("/x")[2] if "called" in each[0]],
    node.requestTopic("/x", "/none", [["TCPROS"]])[0],
)
print(
    [each for each in node.getSubscriptions("/x")[2] if "called" in each[0]],
    node.requestTopic("/x", "/called", [["TCPROS"]])[2][0],
)
print(sorted((each[2], each[4], each[5]) for each in node.getBusInfo("/x")[2] if each[4] == "/called"))
