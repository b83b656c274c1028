#!/usr/bin/env python3
"""Drives to each of `~rooms`, and prints which were reached and how well the robot knew where it was."""

import math
import sys

import actionlib
import rospy
from gazebo_msgs.srv import GetModelState
from geometry_msgs.msg import PoseWithCovarianceStamped
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal


def goal_at(x, y, yaw):
    """Return the goal of a pose in the map."""
    goal = MoveBaseGoal()
    goal.target_pose.header.frame_id = "map"
    goal.target_pose.header.stamp = rospy.Time.now()
    goal.target_pose.pose.position.x, goal.target_pose.pose.position.y = x, y
    goal.target_pose.pose.orientation.z, goal.target_pose.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return goal


class Tour:
    """The robot's way, its own estimate of its place, and the true one."""

    def __init__(self):
        self._estimate = None
        rospy.Subscriber("amcl_pose", PoseWithCovarianceStamped, self._set_estimate)
        self._truth = rospy.ServiceProxy("/gazebo/get_model_state", GetModelState)
        self._client = actionlib.SimpleActionClient("move_base", MoveBaseAction)

    def _set_estimate(self, message):
        self._estimate = message.pose.pose.position

    def place(self):
        """Return the robot's true x, y [m]."""
        at = self._truth("scout", "").pose.position
        return at.x, at.y

    def error(self):
        """Return the distance [m] of amcl's estimate from the robot."""
        return math.dist(self.place(), (self._estimate.x, self._estimate.y))

    def wait(self):
        """Wait for the simulation, amcl and move_base."""
        self._truth.wait_for_service()
        self._client.wait_for_server()
        while self._estimate is None or not self._truth("scout", "").success:
            rospy.sleep(0.1)

    def drive(self, room):
        """Drive to a room; return whether the robot is there."""
        x, y, yaw = room["pose"]
        self._client.send_goal(goal_at(x, y, yaw))
        self._client.wait_for_result()
        text, beside = self._client.get_goal_status_text(), math.dist(self.place(), (x, y))
        print(f"{room['name']}: {text} {beside:.2f} m beside; amcl is {self.error():.2f} m wrong", flush=True)
        return self._client.get_state() == actionlib.GoalStatus.SUCCEEDED and beside < 0.3


def main():
    """Drive through all rooms."""
    rospy.init_node("tour")
    rooms = rospy.get_param("~rooms")
    tour = Tour()
    tour.wait()
    first = tour.error()
    began = rospy.get_time()
    reached = [room["name"] for room in rooms if tour.drive(room)]
    print(
        f"reached {len(reached)} of {len(rooms)} rooms in {rospy.get_time() - began:.0f} s: {', '.join(reached)}; "
        f"amcl was {first:.2f} m wrong at first, {tour.error():.2f} m at the end",
        flush=True,
    )
    sys.exit(len(reached) < len(rooms))


main()
