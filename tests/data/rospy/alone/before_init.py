from wait import said

import rospy
from std_msgs.msg import String
from std_srvs.srv import Empty

publisher = rospy.Publisher("before_init", String, queue_size=1)
print(publisher.resolved_name, publisher.type, publisher.md5sum, publisher.data_class.__name__, publisher.name)
print(said(publisher.publish, "a"))
print(publisher.get_num_connections())
print(said(rospy.spin), said(rospy.get_rostime), rospy.is_shutdown(), rospy.get_node_uri())
print(said(rospy.Publisher, "~private", String, queue_size=1))
print(said(rospy.Publisher, "", String, queue_size=1), said(rospy.Publisher, None, String, queue_size=1))
print(said(rospy.Publisher, 5, String, queue_size=1), said(rospy.Publisher, "a", None, queue_size=1))
print(said(rospy.Publisher, "a", String(), queue_size=1), said(rospy.Publisher, "a", int, queue_size=1))
print(said(rospy.Subscriber, "a", "std_msgs/String"), said(rospy.Subscriber, "a", String, None, None, 0))
print(said(rospy.init_node, ""), said(rospy.init_node, "a/b"), said(rospy.wait_for_service, "a", 0))
print(said(rospy.on_shutdown, 5))
publisher.unregister()
print(publisher.resolved_name, said(publisher.publish, "a"))
publisher.unregister()
