import os
import signal
import threading

import rospy

rospy.init_node("looping")
threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGTERM)).start()
rate = rospy.Rate(50)
try:
    while not rospy.is_shutdown():
        rate.sleep()
    print("loop ends")
except rospy.ROSInterruptException:
    print("interrupted")
