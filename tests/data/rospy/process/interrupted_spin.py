import os
import signal
import threading

import rospy

rospy.init_node("interrupted")
rospy.on_shutdown(lambda: print("hook"))
threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
rospy.spin()
print("after spin", rospy.is_shutdown())
