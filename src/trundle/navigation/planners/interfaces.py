"""What move_base asks of planners."""

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
    """A way of poses in one frame."""

    frame: str
    poses: NDArray[float64]
    """(n, 3): x, y [m], yaw [rad]."""


class GlobalPlanner(Protocol):
    """nav_core::BaseGlobalPlanner."""

    async def make_plan(self, start: Pose2D, goal: Pose2D, tolerance: float | None = None) -> Plan | None:
        """Return a way in the global costmap's frame; None if there is none.

        Args:
            start: pose of the robot.
            goal: its last pose.
            tolerance: greatest distance of the way's end from the goal [m]; None: the planner's own.
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
        """Follow a way from now on."""
        ...

    def velocity(self) -> tuple[float, float, float] | None:
        """Return the velocity to command now, x, y [m/s] and yaw [rad/s] of the robot; None without a valid one."""
        ...

    def is_goal_reached(self) -> bool:
        """True if the robot stands at the way's end."""
        ...
