"""Clock of a simulation's nodes."""

from trundle.ros import GraphLoop, SimClock
from trundle.sim.simulation import Simulation


class SimulationClock(SimClock):
    """Simulation time, exact at every step, also while a timeline repeats it; `set` wakes sleeping nodes."""

    def __init__(self, loop: GraphLoop, simulation: Simulation) -> None:
        super().__init__(loop)
        self._simulation = simulation

    def now_ns(self) -> int:
        """Simulation time [ns]."""
        return self._simulation.time_ns
