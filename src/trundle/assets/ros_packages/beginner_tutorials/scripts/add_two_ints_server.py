#!/usr/bin/env python3
"""Serves `add_two_ints`."""

import rospy
from beginner_tutorials.srv import AddTwoInts, AddTwoIntsResponse


def add(request):
    """Return the sum of a request's two numbers."""
    total = request.a + request.b
    print(f"Returning [{request.a} + {request.b} = {total}]", flush=True)
    return AddTwoIntsResponse(total)


rospy.init_node("add_two_ints_server")
rospy.Service("add_two_ints", AddTwoInts, add)
print("Ready to add two ints.", flush=True)
rospy.spin()
