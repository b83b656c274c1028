#!/usr/bin/env python3
"""Logs what it hears on `chatter`."""

import rospy
from std_msgs.msg import String


def log(message):
    """Log one message with the node's name."""
    rospy.loginfo(f"{rospy.get_caller_id()}I heard {message.data}")


rospy.init_node("listener", anonymous=True)
rospy.Subscriber("chatter", String, log)
rospy.spin()
