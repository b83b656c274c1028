# environment: ROSCONSOLE_FORMAT=${severity}|${node}|${logger}|${message}|${function}|${file}
import os

import rospy

rospy.init_node("formatted")


def speak():
    rospy.loginfo("text")


os.chdir(os.path.dirname(os.path.abspath(__file__)))
speak()
