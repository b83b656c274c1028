"""robot_controllers/FollowJointTrajectoryController and PointHeadController."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from trundle.robots.parameters import RosParameters
from trundle.ros import ActionResult, ActionServer, TransformError, TransformListener

from ..ros_control import ControllerContext, PositionTrajectory

if TYPE_CHECKING:
    from trundle.ros.message_types import control_msgs

_ACTION = "/follow_joint_trajectory"
_HEAD = ("head_pan_joint", "head_tilt_joint")
_SLOWEST = 1e-3
"""[rad/s], of the head, for limits that are missing."""

RequestStart = Callable[[], None]
"""Starts a controller, and stops those with its joints; on the simulation's thread."""


class FollowJointTrajectory(PositionTrajectory):
    """Action `<name>` (control_msgs/FollowJointTrajectory), whose goals start the controller.

    Parameters: joints (required). As joint_trajectory_controller, it also has `command` and `state` beside the action.
    """

    def __init__(self, context: ControllerContext, request_start: RequestStart) -> None:
        super().__init__(replace(context, name=context.name.removesuffix(_ACTION)))
        self._request_start = request_start

    def _begin_goal(self, goal: "control_msgs.FollowJointTrajectoryGoal") -> None:
        self._request_start()
        super()._begin_goal(goal)


class PointHead(FollowJointTrajectory):
    """Action `<name>` (control_msgs/PointHead): turns pan and tilt to a point of any frame."""

    def __init__(self, context: ControllerContext, request_start: RequestStart) -> None:
        settings = RosParameters({"joints": list(_HEAD)}, context.name)
        pan, tilt = (context.joint(name, "PositionJointInterface").handle.joint for name in _HEAD)
        self._frames = (pan.parent, pan.child)
        self._speeds = [math.inf if joint.axis is None else joint.axis.velocity for joint in (pan, tilt)]
        self._buffer = TransformListener(context.node).buffer
        super().__init__(replace(context, settings=settings), request_start)

    def _serve(self, context: ControllerContext) -> ActionServer:
        return ActionServer(context.node, context.name, "control_msgs/PointHead", self._on_point, concurrent=True)

    def _feedback_fields(self) -> dict[str, Any]:
        return {}

    async def _on_point(self, goal: "control_msgs.PointHeadGoal", accept: Callable[[], None]) -> ActionResult:
        """Turn a point into a trajectory of two joints, on the loop."""
        target, frame = goal.target.point, goal.target.header.frame_id
        try:
            in_parent, in_pan = (
                self._buffer.lookup_transform(name, frame).pose.transform_point((target.x, target.y, target.z))
                for name in self._frames
            )
        except TransformError as error:
            self._node.log.warn(f"Could not transform goal: {error}")
            accept()
            return ActionResult(status="aborted", text="Could not transform goal.")
        angles = [math.atan2(in_parent[1], in_parent[0]), -math.atan2(in_pan[2], math.hypot(in_pan[0], in_pan[1]))]
        fastest = float(goal.max_velocity) or math.inf
        spans = [
            abs(joint.error(angle)) / max(min(speed, fastest), _SLOWEST)
            for joint, angle, speed in zip(self._joints, angles, self._speeds, strict=True)
        ]
        point = {
            "positions": angles,
            "velocities": [0.0, 0.0],
            "accelerations": [0.0, 0.0],
            "time_from_start": round(max(*spans, _SLOWEST) * 1e9),
        }
        trajectory = {"joint_names": list(_HEAD), "points": [point]}
        follow = self._node.new("control_msgs/FollowJointTrajectoryGoal", {"trajectory": trajectory})
        result = await self._on_goal(follow, accept)
        return ActionResult(status=result.status, text=result.text)
