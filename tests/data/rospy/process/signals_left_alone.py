import os
import signal
import time

import rospy

rospy.init_node("own_signals", disable_signals=True)
try:
    os.kill(os.getpid(), signal.SIGINT)
    time.sleep(30)
except KeyboardInterrupt:
    print("KeyboardInterrupt", rospy.is_shutdown())
