import rospy
from rosgraph_msgs.msg import Log
from wait import until

rospy.init_node("tester")
received = []
subscriber = rospy.Subscriber("/rosout", Log, lambda log: received.append(log.msg) if log.msg.startswith("@") else None)
until(lambda: subscriber.get_num_connections() >= 1)
rospy.sleep(0.5)
for number in range(5):
    rospy.loginfo_throttle(100, f"@throttled {number}")
    rospy.logwarn_once(f"@once {number}")
    rospy.logerr_throttle_identical(100, f"@identical {number // 2}")
for number in range(3):
    rospy.logwarn_throttle(0.0001, f"@short {number}")
    rospy.sleep(0.01)
rospy.loginfo("@end")
until(lambda: "@end" in received)
print(received)
