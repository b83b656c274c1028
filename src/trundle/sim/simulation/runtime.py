"""Interface of a running world as its handles and actors see it."""

from typing import Protocol

from trundle.robots.model import World
from trundle.sim.physics import Engine

from .applied_loads import AppliedLoads


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

    def expiry_step(self, duration_s: float | None) -> int | None:
        """Return the step at which a load that begins now and lasts `duration_s` ends; None: never."""
        ...

    def time_left(self, until: int | None) -> float | None:
        """Return how much longer a load lasts that ends at a step [s]; None: for ever."""
        ...

    def edit(self, world: World) -> None:
        """Continue with an edited world of the same models, links and joints."""
        ...

    def finish_reset(self, model: object) -> None:
        """Call what waits for resets of one model, by its handle."""
        ...
