import rospy
from std_msgs.msg import String
from wait import said

rospy.init_node("ending")
publisher = rospy.Publisher("ending", String, queue_size=1)


def last_words():
    print("hook", rospy.is_shutdown(), rospy.core.is_shutdown_requested(), rospy.has_param("/run_id"))
    publisher.publish("bye")


rospy.on_shutdown(last_words)
rospy.on_shutdown(lambda: print("second hook"))
rospy.core.add_preshutdown_hook(lambda reason: print("before", reason, rospy.is_shutdown()))
rospy.core.add_shutdown_hook(lambda reason: print("during", reason, rospy.is_shutdown()))
rospy.signal_shutdown("enough")
print(rospy.is_shutdown(), said(publisher.publish, "too late"))
rospy.signal_shutdown("again")
rospy.on_shutdown(lambda: print("at once"))
rospy.spin()
print("spin returns")
