"""Interfaces of planners for move_base."""

from typing import NamedTuple, Protocol

from numpy import float64
from numpy.typing import NDArray


class Pose2D(NamedTuple):
    """A pose in the plane of a frame."""

    x: float
    """[m]"""
    y: float
    """[m]"""
    yaw: float
    """[rad]"""


class Plan(NamedTuple):
    """A path: poses in one frame."""

    frame: str
    poses: NDArray[float64]
    """(n, 3): x, y [m], yaw [rad]."""


class GlobalPlanner(Protocol):
    """nav_core::BaseGlobalPlanner."""

    async def make_plan(self, start: Pose2D, goal: Pose2D, tolerance: float | None = None) -> Plan | None:
        """Return a path in the global costmap's frame; None if there is none.

        Args:
            start: pose of the robot.
            goal: last pose of the path.
            tolerance: greatest distance of the path's end from the goal [m]; None: the planner's own.
        """
        ...

    def publish(self, plan: Plan) -> None:
        """Publish a plan on the planner's topic."""
        ...


class LocalPlanner(Protocol):
    """nav_core::BaseLocalPlanner."""

    speed_limits: tuple[float, float]
    """Greatest speed [m/s] and turning speed [rad/s]."""

    def start(self) -> None:
        """Begin a new goal."""
        ...

    def set_plan(self, plan: Plan) -> None:
        """Follow a path from now on."""
        ...

    def velocity(self) -> tuple[float, float, float] | None:
        """Return the velocity to command, x, y [m/s] and yaw [rad/s] in the robot's frame; None if none is valid."""
        ...

    def is_goal_reached(self) -> bool:
        """True if the robot stands at the path's end."""
        ...
