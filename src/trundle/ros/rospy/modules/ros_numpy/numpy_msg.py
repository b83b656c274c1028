"""Message classes whose arrays are numpy's."""

from rospy.numpy_msg import numpy_msg as numpy_msg
