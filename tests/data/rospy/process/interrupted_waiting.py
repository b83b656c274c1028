import os
import signal
import threading

import rospy
from std_msgs.msg import String
from std_srvs.srv import Empty
from wait import said

rospy.init_node("waiting")
threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
print(said(rospy.wait_for_message, "never", String))
print(said(rospy.wait_for_service, "never", 30))
print(said(rospy.wait_for_service, "never"))
print(rospy.is_shutdown())
