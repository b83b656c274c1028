#!/usr/bin/env python3
"""Asks `add_two_ints` for the sum of the two numbers on its command line."""

import sys

import rospy
from beginner_tutorials.srv import AddTwoInts


def main():
    """Call the service once, and print the sum."""
    try:
        a, b = map(int, rospy.myargv()[1:])
    except ValueError:
        sys.exit(f"usage: {sys.argv[0]} X Y")
    print(f"Requesting {a}+{b}", flush=True)
    rospy.wait_for_service("add_two_ints")
    try:
        answer = rospy.ServiceProxy("add_two_ints", AddTwoInts)(a, b)
    except rospy.ServiceException as error:
        sys.exit(f"Service call failed: {error}")
    print(f"{a} + {b} = {answer.sum}", flush=True)


main()
