"""Interface of a running world as its handles and actors see it."""

from typing import Protocol

from trundle.model import World
from trundle.physics import Engine

from .applied_loads import AppliedLoads


class Runtime(Protocol):
    """The engine, what drives it, and its time."""

    @property
    def engine(self) -> Engine:
        """Simulates the world of the moment."""
        ...

    @property
    def world(self) -> World:
        """As it was compiled."""
        ...

    @property
    def loads(self) -> AppliedLoads:
        """Wrenches and efforts that last for a while."""
        ...

    @property
    def time_ns(self) -> int:
        """Simulation time [ns]."""
        ...

    def expiry_step(self, duration_s: float | None) -> int | None:
        """The step at which what begins now and lasts so long is over; None: it lasts."""
        ...

    def edit(self, world: World) -> None:
        """Go on with an edited world of the same models, links and joints."""
        ...
