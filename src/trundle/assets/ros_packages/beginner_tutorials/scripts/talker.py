#!/usr/bin/env python3
"""Publishes `hello world` and the time on `chatter`, ten times a second."""

import rospy
from std_msgs.msg import String


def main():
    """Publish until the node shuts down."""
    rospy.init_node("talker", anonymous=True)
    publisher = rospy.Publisher("chatter", String, queue_size=10)
    rate = rospy.Rate(10)  # Hz
    while not rospy.is_shutdown():
        text = f"hello world {rospy.get_time()}"
        rospy.loginfo(text)
        publisher.publish(text)
        rate.sleep()


try:
    main()
except rospy.ROSInterruptException:
    pass
