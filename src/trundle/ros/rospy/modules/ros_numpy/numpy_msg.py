"""Message classes with numpy arrays."""

from rospy.numpy_msg import numpy_msg as numpy_msg
