# environment: ROS_NAMESPACE=/robot/arm
import rospy
from std_msgs.msg import String

print(rospy.get_namespace(), rospy.get_name(), rospy.resolve_name("x"))
rospy.init_node("mover")
print(
    rospy.get_namespace(), rospy.get_name(), rospy.resolve_name("x"), rospy.resolve_name("~x"), rospy.resolve_name("")
)
rospy.set_param("here", 1)
rospy.set_param("~mine", 2)
rospy.set_param("/robot/above", 3)
print(rospy.get_param("/robot/arm/here"), rospy.get_param("/robot/arm/mover/mine"), rospy.search_param("above"))
print(rospy.Publisher("topic", String, queue_size=1).resolved_name)
rospy.delete_param("/robot")
