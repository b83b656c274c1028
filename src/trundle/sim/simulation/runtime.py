"""Interface of a running world for its handles and actors."""

from typing import Protocol

from trundle.robots.model import World
from trundle.sim.physics import Engine

from .applied_loads import AppliedLoads
from .resets import Resets


class Runtime(Protocol):
    """Engine, loads and time of a running world."""

    @property
    def engine(self) -> Engine:
        """Engine of the current world."""
        ...

    @property
    def world(self) -> World:
        """World as compiled."""
        ...

    @property
    def loads(self) -> AppliedLoads:
        """Timed wrenches and efforts."""
        ...

    @property
    def time_ns(self) -> int:
        """Simulation time [ns]."""
        ...

    def edit(self, world: World) -> None:
        """Continue with an edited world of the same models, links and joints."""
        ...

    @property
    def resets(self) -> Resets:
        """Functions called after resets."""
        ...
