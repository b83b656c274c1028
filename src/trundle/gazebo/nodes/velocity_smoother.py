"""yocs_velocity_smoother: velocity commands within limits of speed and acceleration, as on a TurtleBot 2."""

import statistics
from collections import deque
from typing import TYPE_CHECKING

from trundle.robots.parameters import ParamError
from trundle.ros import Node
from trundle.spatial import NS_PER_S

from .host import NodeHost
from .private_parameters import private_parameters
from .rate import Rate

if TYPE_CHECKING:
    from trundle.ros.message_types import geometry_msgs, nav_msgs

_KIND = "geometry_msgs/Twist"
_PERIODS = 5
"""Number of messages whose median interval counts as the input's period."""
_FIRST_PERIOD_S, _LONGEST_SILENCE_S = 0.1, 0.5
_ODOMETRY, _COMMANDS = 1, 2
"""Values of robot_feedback, the source of the robot's velocity; 0: none."""
_Velocity = tuple[float, float]
"""x [m/s], yaw [rad/s]."""


class VelocitySmoother:
    """Publishes `~smooth_cmd_vel`: the commands on `~raw_cmd_vel`, in steps that both axes can make.

    Parameters, with the original's defaults: speed_lim_v, speed_lim_w, accel_lim_v and accel_lim_w (required),
    decel_factor 1, frequency 20, robot_feedback 0 (1: `~odometry`, 2: `~robot_cmd_vel`).
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._target: _Velocity = (0.0, 0.0)
        self._last: _Velocity = (0.0, 0.0)
        self._robot: _Velocity = (0.0, 0.0)
        self._is_active = False
        self._received_ns = 0
        self._periods_s: deque[float] = deque(maxlen=_PERIODS)

    async def run(self) -> int:
        """Smooth until cancelled."""
        node = self._node
        try:
            parameters = await private_parameters(node)
            self._speeds = parameters.number("speed_lim_v"), parameters.number("speed_lim_w")
            accelerations = parameters.number("accel_lim_v"), parameters.number("accel_lim_w")
            decel_factor = parameters.number("decel_factor", 1.0)
            frequency_hz = parameters.number("frequency", 20.0, above=0.0)
            feedback = parameters.integer("robot_feedback", 0)
        except ParamError as error:
            node.log.error(str(error))
            return 1
        self._rises = accelerations[0] / frequency_hz, accelerations[1] / frequency_hz
        self._falls = self._rises[0] * decel_factor, self._rises[1] * decel_factor
        self._has_feedback = feedback in (_ODOMETRY, _COMMANDS)
        self._output = node.advertise("~smooth_cmd_vel", _KIND, queue_size=1)
        node.subscribe("~raw_cmd_vel", _KIND, self._on_command, queue_size=1)
        if feedback == _ODOMETRY:
            node.subscribe("~odometry", "nav_msgs/Odometry", self._on_odometry, queue_size=1)
        if feedback == _COMMANDS:
            node.subscribe("~robot_cmd_vel", _KIND, self._on_robot_command, queue_size=1)
        rate = Rate(node, frequency_hz)
        while not node.closed.is_set():
            self._step()
            await rate.sleep()
        return 0

    def _on_command(self, message: "geometry_msgs.Twist") -> None:
        now_ns = self._node.clock.now_ns()
        self._periods_s.append((now_ns - self._received_ns) / NS_PER_S)
        self._received_ns = now_ns
        self._is_active = True
        speed, turn = self._speeds
        self._target = _within(message.linear.x, speed), _within(message.angular.z, turn)

    def _on_odometry(self, message: "nav_msgs.Odometry") -> None:
        self._robot = message.twist.twist.linear.x, message.twist.twist.angular.z

    def _on_robot_command(self, message: "geometry_msgs.Twist") -> None:
        self._robot = message.linear.x, message.angular.z

    def _step(self) -> None:
        """Publish the next command, while there is input or the robot has not reached the last input yet."""
        self._watch_input()
        if self._has_feedback and self._is_active and self._differs_from_robot():
            self._last = self._robot
        if self._target != self._last:
            self._last = self._next()
        elif not self._is_active:
            return
        x, turn = self._last
        self._output.publish({"linear": {"x": x}, "angular": {"z": turn}})

    def _watch_input(self) -> None:
        """Stop the robot when no input arrives any more."""
        is_known = len(self._periods_s) > _PERIODS // 2
        period_s = statistics.median(self._periods_s) if is_known else _FIRST_PERIOD_S
        silent_s = (self._node.clock.now_ns() - self._received_ns) / NS_PER_S
        if not self._is_active or silent_s <= min(3.0 * period_s, _LONGEST_SILENCE_S):
            return
        self._is_active = False
        if self._target != (0.0, 0.0):
            x, turn = self._target
            self._node.log.warn(
                "Velocity Smoother : input got inactive leaving us a non-zero target velocity "
                f"({x:g}, {turn:g}), zeroing..."
            )
            self._target = (0.0, 0.0)

    def _differs_from_robot(self) -> bool:
        """True if the robot's velocity is further from the last command than two steps."""
        axes = zip(self._robot, self._last, self._rises, self._falls, strict=True)
        return any(not last - 2.0 * fall <= robot <= last + 2.0 * rise for robot, last, rise, fall in axes)

    def _next(self) -> _Velocity:
        """Return the velocity after a step in the target's direction, as long as both axes can make it."""
        share = 1.0
        for target, last, rise, fall in zip(self._target, self._last, self._rises, self._falls, strict=True):
            change = target - last
            if change:
                share = min(share, (rise if change * target > 0.0 else fall) / abs(change))
        if share >= 1.0:
            return self._target
        x, turn = (last + share * (target - last) for target, last in zip(self._target, self._last, strict=True))
        return x, turn


def _within(value: float, limit: float) -> float:
    """Return a value within ± a limit; 0 for NaN."""
    return min(max(value, -limit), limit) if value == value else 0.0
