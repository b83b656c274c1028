"""Profile of a simulation for its page, measured while it is watched."""

import time
from collections.abc import Callable

from trundle.page import PERFORMANCE, PageServer
from trundle.ros import Node
from trundle.sim.simulation import Simulation, StridePart

from ..profile.part_names import LoopPart
from ..profile.stride_profile import StrideProfile

_PERIOD_NS = 1_000_000_000
"""Interval between the starts of two profiles in wall time, and limit of each profile in wall and simulation time [ns].

The limit of simulation time matters at full speed: measuring a world without sensors costs a sixth of its time.
"""


class PerformanceStream:
    """Sends profiles to the page; belongs to the simulation's thread."""

    def __init__(self, server: PageServer, *, wall_ns: Callable[[], int] = time.perf_counter_ns) -> None:
        """Create it; `show` sets the simulation.

        Args:
            server: page's server.
            wall_ns: the wall clock [ns].
        """
        self._server = server
        self._wall_ns = wall_ns
        self._profile: StrideProfile | None = None

    def show(self, simulation: Simulation, node: Node | None) -> None:
        """Measure another simulation; `node` belongs to its ROS graph, None: without ROS."""
        self.close()
        self._profile = StrideProfile(simulation, None if node is None else node.loop, wall_ns=self._wall_ns)
        self._after_strides = StridePart.SCHEDULE if node is None else LoopPart.DELIVERY
        self._due_ns = 0

    def begin_page(self) -> None:
        """Attribute the time since the strides; from here on, the page's own time counts."""
        if self._profile is not None and self._profile.is_on:
            self._profile.lap(self._after_strides)

    def end_page(self, *, paused: bool) -> None:
        """Count the page's own time, and send a profile if it is complete."""
        profile, now = self._profile, self._wall_ns()
        if profile is None or paused or not self._server.is_watched(PERFORMANCE):
            self.close()
            self._due_ns = now
            return
        if profile.is_on:
            profile.lap(LoopPart.PAGE)
            if now >= self._due_ns or profile.simulated_ns >= _PERIOD_NS:
                self._server.put_performance(profile.read())
                profile.stop()
        if not profile.is_on and now >= self._due_ns:
            self._due_ns = now + _PERIOD_NS
            profile.start()

    def close(self) -> None:
        """Stop measuring."""
        if self._profile is not None:
            self._profile.stop()
