"""Profiler of a simulation: attributes the wall time of its strides to their parts."""

import time
from collections.abc import Callable, Generator
from contextlib import contextmanager
from threading import get_ident
from typing import TYPE_CHECKING, Self

from trundle.base.documented import documented
from trundle.sim.simulation import Simulation, StridePart
from trundle.spatial import NS_PER_S

from ..world.profile import Profile, ProfilePart
from .part_names import LoopPart, group_and_name
from .physics_shares import PhysicsShares

if TYPE_CHECKING:  # lazy: only runs with a graph load it
    from trundle.ros import GraphLoop

_PHYSICS = StridePart.PHYSICS


@documented("read")
class StrideProfile:
    """Profiler of one simulation, on its thread; as a context manager, it measures inside the `with` statement."""

    __module__ = "trundle"

    def __init__(
        self,
        simulation: Simulation,
        loop: "GraphLoop | None",
        *,
        wall_ns: Callable[[], int] = time.perf_counter_ns,
    ) -> None:
        """Create it; `start` starts measuring.

        Args:
            simulation: running simulation.
            loop: graph's loop, with the nodes of plugins; None: without ROS.
            wall_ns: the wall clock [ns].
        """
        self._simulation = simulation
        self._loop = loop
        self._wall_ns = wall_ns
        self._thread = get_ident()
        self._physics = PhysicsShares(simulation)
        self.restart()

    @property
    def is_on(self) -> bool:
        """True from `start` to `stop`."""
        return self._simulation.profiler is self

    @property
    def simulated_ns(self) -> int:
        """Simulated time since the start [ns]."""
        return self._simulation.simulated_ns - self._start[0]

    def start(self) -> None:
        """Start measuring."""
        self._simulation.profiler = self
        if self._loop is not None:
            self._loop.publish_timer = self._publishing
        self.restart()

    def stop(self) -> None:
        """Stop measuring."""
        if self.is_on:
            self._simulation.profiler = None
            if self._loop is not None:
                self._loop.publish_timer = None
            self._physics.stop()

    def restart(self) -> None:
        """Discard the measurements."""
        self._physics.stop()
        self._physics = PhysicsShares(self._simulation)
        self._parts: dict[int, object] = {}
        self._costs: dict[int, float] = {}
        """Wall time of parts [ns], by the part's id as above."""
        self._inner_ns = 0
        """Time since the last lap that is already attributed [ns]."""
        self._start = (self._simulation.simulated_ns, self._simulation.simulated_steps)
        self._graph_start_ns = self._graph_ns
        self._start_ns = self._last_ns = self._wall_ns()

    @property
    def _graph_ns(self) -> int | None:
        return None if self._loop is None else self._loop.processor_ns

    def _graph_s(self) -> float | None:
        """Processor time of the graph's thread since the start [s]."""
        start_ns, now_ns = self._graph_start_ns, self._graph_ns
        return None if start_ns is None or now_ns is None else (now_ns - start_ns) / NS_PER_S

    def lap(self, *parts: object) -> None:
        """Attribute the time since the last lap to parts, equally; see `trundle.sim.simulation.Profiler`."""
        now = self._wall_ns()
        spent = now - self._last_ns - self._inner_ns
        self._last_ns, self._inner_ns = now, 0
        for part in parts:
            self._charge(part, spent / len(parts))
        if _PHYSICS in parts:
            self._physics.end_stride()

    def _charge(self, part: object, spent_ns: float) -> None:
        key = id(part)
        if key in self._costs:
            self._costs[key] += spent_ns
        else:
            self._parts[key], self._costs[key] = part, spent_ns

    @contextmanager
    def _publishing(self) -> Generator[None]:
        """Attribute the time of publishing a message within another part, unless another thread publishes it."""
        if get_ident() != self._thread:
            yield
            return
        start = self._wall_ns()
        try:
            yield
        finally:
            spent = self._wall_ns() - start
            self._charge(LoopPart.PUBLISHING, spent)
            self._inner_ns += spent

    def read(self) -> Profile:
        """Return the measurements since the last call, up to the last lap, and restart."""
        simulation = self._simulation
        profile = Profile(
            wall_s=(self._last_ns - self._start_ns) / NS_PER_S,
            simulated_s=self.simulated_ns / NS_PER_S,
            steps=simulation.simulated_steps - self._start[1],
            contacts=simulation.engine.contact_count,
            bodies=len(simulation.engine.compiled.link_names),
            asleep=simulation.engine.asleep,
            graph_s=self._graph_s(),
            parts=tuple(sorted(self._profile_parts(), key=lambda part: -part.wall_s)),
        )
        self.restart()
        return profile

    def _profile_parts(self) -> list[ProfilePart]:
        physics: list[ProfilePart] = []
        others: dict[tuple[object, ...], ProfilePart] = {}
        for key, spent_ns in self._costs.items():
            part = self._parts[key]
            if part is _PHYSICS:
                physics = self._physics.parts(spent_ns / NS_PER_S)
                continue
            group, name = group_and_name(part, self._simulation)
            before_s = others[group, name].wall_s if (group, name) in others else 0.0
            others[group, name] = ProfilePart(group=group, name=name, wall_s=before_s + spent_ns / NS_PER_S)
        return [*physics, *others.values()]

    def __enter__(self) -> Self:
        self.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()
