import threading

import rospy
from std_msgs.msg import String
from wait import said

rospy.init_node("tester")
publisher = rospy.Publisher("awaited", String, latch=True, queue_size=1)
publisher.publish("here")
print(rospy.wait_for_message("awaited", String), rospy.wait_for_message("awaited", String, timeout=30).data)
print(said(rospy.wait_for_message, "never", String, timeout=0.2))
print(said(rospy.wait_for_message, "never", String, timeout=rospy.Duration(0.1)))
print(threading.current_thread().name)
