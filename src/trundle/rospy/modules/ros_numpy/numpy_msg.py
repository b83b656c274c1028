"""Message classes whose arrays are numpy's."""

import functools

import rospy.numpy_msg


@functools.cache
def numpy_msg(cls):
    """The class for Subscribers that get arrays as numpy's; always the same one for a class."""
    return rospy.numpy_msg.numpy_msg(cls)
