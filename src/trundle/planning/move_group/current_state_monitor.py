"""The robot's present state: joint_states, and tf for planar and floating joints."""

import asyncio
import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from trundle.ros import Node, TransformBuffer, TransformError, to_nsec
from trundle.spatial import NS_PER_S

if TYPE_CHECKING:
    from trundle.planning.robot_model import JointModel, RobotModel
    from trundle.ros.message_types import sensor_msgs

_POLL_S = 0.01
_BOUNDS_ERROR = 1e-9
"""Error of positions at their limits that is corrected [rad] or [m]; the original takes machine precision."""


class CurrentStateMonitor:
    """Keeps the last reported position of each variable; all on the loop."""

    def __init__(self, node: Node, model: "RobotModel", buffer: TransformBuffer, topic: str = "joint_states") -> None:
        """Subscribe to joint states.

        Args:
            node: node that subscribes.
            model: robot.
            buffer: tf, for planar and floating joints.
            topic: joint states.
        """
        self._node = node
        self._model = model
        self._buffer = buffer
        self._positions = model.default_positions()
        self._velocities = np.zeros(len(model.variables))
        self._stamps_ns: dict[str, int] = {}
        self._named_missing: list[str] = []
        """Joints that the last warning about an incomplete state named."""
        self._multi = [joint for joint in model.joints if len(joint.variables) > 1]
        self._needed = [
            joint.name
            for joint in model.joints
            if len(joint.variables) == 1 and joint.mimic is None and not joint.passive
        ]
        self.on_update: list[Callable[[], None]] = []
        """Called after each joint state."""
        node.subscribe(topic, "sensor_msgs/JointState", self._receive, queue_size=25, on_loop=True)
        node.log.info(f"Listening to '{node.resolve(topic)}' for joint states")

    def _receive(self, message: "sensor_msgs.JointState") -> None:
        if len(message.name) != len(message.position):
            self._node.log.warn(
                f"State monitor received invalid joint state (number of joint names does not match number of "
                f"positions): {len(message.name)} names, {len(message.position)} positions"
            )
            return
        stamp_ns = to_nsec(message.header.stamp) or self._node.clock.now_ns()
        has_velocities = len(message.velocity) == len(message.name)
        model = self._model
        for index, (name, position) in enumerate(zip(message.name, message.position, strict=True)):
            if not model.has_joint(name) or not math.isfinite(position):
                continue
            variables = model.joint(name).variables
            if len(variables) != 1:
                continue
            number = model.variable_index(name)
            lower, upper = float(model.lower[number]), float(model.upper[number])
            if model.is_bounded[number] and lower - _BOUNDS_ERROR <= position <= upper + _BOUNDS_ERROR:
                position = min(max(position, lower), upper)
            self._positions[number] = position
            self._velocities[number] = message.velocity[index] if has_velocities else 0.0
            self._stamps_ns[name] = stamp_ns
        for callback in self.on_update:
            callback()

    def positions(self) -> np.ndarray:
        """Return the present state vector; what is not known is at its default."""
        for joint in self._multi:
            self._follow(joint)
        return self._model.with_mimics(self._positions)

    def velocities(self) -> np.ndarray:
        """Return the reported velocity of each variable; 0 where none is reported."""
        return self._velocities.copy()

    def _follow(self, joint: "JointModel") -> None:
        parent = joint.parent_link or self._model.model_frame
        try:
            transform = self._buffer.lookup_transform(parent, joint.child_link)
        except TransformError:
            return
        x, y, z = transform.pose.position
        w, qx, qy, qz = transform.pose.quaternion
        values = [x, y, transform.pose.rpy[2]] if joint.type == "planar" else [x, y, z, qx, qy, qz, w]
        for variable, value in zip(joint.variables, values, strict=True):
            self._positions[self._model.variable_index(variable)] = value
        self._stamps_ns[joint.name] = transform.stamp_ns

    def stale(self, since_ns: int) -> list[str]:
        """Return the joints of which nothing newer is known."""
        return [name for name in self._needed if self._stamps_ns.get(name, 0) < since_ns]

    def stamp_ns(self) -> int:
        """Return the time of the oldest position; 0 if one is unknown."""
        return min((self._stamps_ns.get(name, 0) for name in self._needed), default=self._node.clock.now_ns())

    async def wait_since(self, since_ns: int, wait_s: float = 1.0) -> bool:
        """Wait until every joint was reported at a time or later; False if that takes more than `wait_s` (ROS time)."""
        clock = self._node.clock
        start_ns = clock.now_ns()
        while self.stamp_ns() < since_ns:
            if self._node.closed.is_set():
                return False
            if clock.now_ns() - start_ns > wait_s * NS_PER_S:
                self._report_missing(wait_s)
                return False
            await asyncio.sleep(_POLL_S)
        return True

    def _report_missing(self, wait_s: float) -> None:
        """Log that no recent state came; joints that were never reported are a warning, once for each set of them."""
        self._node.log.info(
            f"Didn't receive robot state (joint angles) with recent timestamp within {wait_s:f} seconds"
        )
        missing = [name for name in self._needed if name not in self._stamps_ns]
        if missing and missing != self._named_missing:
            self._node.log.warn(f"The complete state of the robot is not yet known.  Missing {', '.join(missing)}")
        self._named_missing = missing
