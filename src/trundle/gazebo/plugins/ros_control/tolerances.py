"""Tolerances of trajectories, from parameters and from the goals of actions."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Self

from msgspec import Struct

from trundle.robots.parameters import RosParameters
from trundle.ros import Message, to_nsec

if TYPE_CHECKING:
    from trundle.ros.message_types import control_msgs

_DEFAULT_STOPPED_VELOCITY = 0.01
"""Default stopped_velocity_tolerance of the original [rad/s or m/s]."""


class StateTolerance(Struct, frozen=True):
    """Largest errors of a joint; 0: not checked. Accelerations are not measured, so their error is 0."""

    position: float = 0.0
    """[rad or m]"""
    velocity: float = 0.0
    """[rad/s or m/s]"""

    def allows(self, position_error: float, velocity_error: float) -> bool:
        """Return True if both errors are within the tolerance."""
        return not (0.0 < self.position < abs(position_error) or 0.0 < self.velocity < abs(velocity_error))

    def updated(self, tolerance: Message) -> Self:
        """Return the tolerance with a control_msgs/JointTolerance: 0 leaves a value, a negative one ends its check."""
        return type(self)(_updated(self.position, tolerance.position), _updated(self.velocity, tolerance.velocity))


class JointTolerances(Struct, frozen=True):
    """Tolerances of one joint."""

    path: StateTolerance = StateTolerance()
    goal: StateTolerance = StateTolerance()
    time_ns: int = 0
    """Time after the end in which the goal has to be reached [ns]."""


def read_tolerances(constraints: RosParameters, joints: Sequence[str]) -> list[JointTolerances]:
    """Read the parameters `constraints`: goal_time 0, stopped_velocity_tolerance 0.01, <joint>/trajectory 0 and
    <joint>/goal 0.
    """
    stopped = constraints.number("stopped_velocity_tolerance", _DEFAULT_STOPPED_VELOCITY)
    time_ns = round(constraints.number("goal_time", 0.0) * 1e9)
    return [
        JointTolerances(
            StateTolerance(joint_constraints.number("trajectory", 0.0)),
            StateTolerance(joint_constraints.number("goal", 0.0), stopped),
            time_ns,
        )
        for joint_constraints in map(constraints.section, joints)
    ]


def goal_tolerances(
    defaults: Sequence[JointTolerances], goal: "control_msgs.FollowJointTrajectoryGoal", joints: Sequence[str]
) -> list[JointTolerances]:
    """Return the default tolerances with those of an action's goal."""
    time_ns = to_nsec(goal.goal_time_tolerance)

    def updated(default: JointTolerances, joint: str) -> JointTolerances:
        path_tolerance, goal_tolerance = default.path, default.goal
        for tolerance in goal.path_tolerance:
            path_tolerance = path_tolerance.updated(tolerance) if tolerance.name == joint else path_tolerance
        for tolerance in goal.goal_tolerance:
            goal_tolerance = goal_tolerance.updated(tolerance) if tolerance.name == joint else goal_tolerance
        return JointTolerances(path_tolerance, goal_tolerance, max(time_ns, 0) if time_ns else default.time_ns)

    return [updated(default, joint) for default, joint in zip(defaults, joints, strict=True)]


def _updated(value: float, requested: float) -> float:
    return float(requested) if requested > 0.0 else 0.0 if requested < 0.0 else value
