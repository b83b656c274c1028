"""Steps of the simulation behind /gazebo: in real time, flat out or in lockstep with nodes, unless it is paused."""

from collections.abc import Callable
from functools import partial

from trundle.gazebo.plugin_error import plugin_error
from trundle.ros import GraphLoop, SimClock
from trundle.sim.physics import SimulationUnstableError
from trundle.sim.realtime_pacer import STRIDE_FLAT_OUT_NS, RealtimePacer
from trundle.sim.simulation import Simulation

from ..live_world import LiveWorld
from ..lockstep import Lockstep
from .simulation_thread import SimulationThread

IDLE_S = 0.01


class GazeboStepper:
    """Advances one simulation; on its thread."""

    def __init__(
        self,
        loop: GraphLoop,
        thread: SimulationThread,
        *,
        speed: float | None,
        lockstep: Lockstep | None,
        say: Callable[[str], None],
    ) -> None:
        """Prepare.

        Args:
            loop: the nodes' event loop.
            thread: the simulation's thread.
            speed: real-time factor; None: flat out.
            lockstep: holds time until the nodes have settled; None: time never waits.
            say: prints why the simulation stopped.
        """
        self._loop = loop
        self._calls = thread.calls
        self._ending = thread.ending
        self._lockstep = lockstep
        self._say = say
        self.pacer = RealtimePacer(speed)
        self.clock = SimClock(loop)
        """Clock of the plugins' nodes; zero before a world is open."""
        self.paused = False
        self.is_held = True
        """True until all services are registered."""
        self.stop_reason: str | None = None
        """Reason why the simulation had to stop; None: it runs."""

    @property
    def is_lockstep(self) -> bool:
        """True if time waits for the nodes at each step."""
        return self._lockstep is not None

    @property
    def is_over(self) -> bool:
        """True at the end of a run in lockstep."""
        return self._lockstep is not None and self._lockstep.over.is_set()

    def set_paused(self, paused: bool) -> None:
        """Pause or resume."""
        self.paused = paused
        self.pacer.restart()

    def restart(self, time_ns: int) -> None:
        """Continue after a jump in time [ns]."""
        self.clock.set(time_ns)
        self.pacer.restart()

    def begin(self) -> None:
        """Hold time, and in lockstep the nodes' messages too, until it advances."""
        self.is_held = True
        if self._lockstep is not None:
            self._loop.begin_batch()

    def step(self, live: LiveWorld) -> None:
        """Advance to the pacer's next target, or wait briefly while paused."""
        simulation = live.simulation
        if self.paused or self.is_held or not (self._lockstep is None or self._lockstep.is_ready):
            self.pacer.restart()
            simulation.advance(simulation.time_ns)
            self.clock.set(simulation.time_ns)  # the page may have moved along the timeline
            self._loop.end_batch()
            self._ending.wait(IDLE_S)
            return
        try:
            target_ns = self.pacer.next_target(simulation.time_ns)
            if self._lockstep is None or target_ns == simulation.time_ns:
                live.advance(target_ns)
            else:
                target_ns = simulation.time_ns + STRIDE_FLAT_OUT_NS  # not the pacer's, so that runs repeat
                step = partial(self._step_lockstep, simulation, self._lockstep)
                live.advance(self._lockstep.target_ns(target_ns), step)
        except SimulationUnstableError as error:
            self._stop(str(error))
        except Exception as error:  # a plugin may raise anything
            self._stop(str(plugin_error(error) or f"{type(error).__name__}: {error}"))
        self.clock.set(simulation.time_ns)
        if self._lockstep is None and self.pacer.speed is None:
            self._loop.flush_deliveries()  # delivery order does not depend on the machine's speed

    def _step_lockstep(self, simulation: Simulation, steps: Lockstep, until_ns: int) -> None:
        """Advance hook by hook, and wait after each until the nodes have settled."""
        end_ns = simulation.simulated_ns + until_ns - simulation.time_ns  # a node may reset the time between two hooks
        while (left_ns := end_ns - simulation.simulated_ns) > 0 and not self.paused and not self._ending.is_set():
            if steps.over.is_set():
                return
            simulation.stride(simulation.time_ns + left_ns)
            self.clock.set(simulation.time_ns)
            steps.wait_settled(
                self._calls.run_pending, lambda: self._calls.has_pending() or self._ending.is_set(), self._ending.is_set
            )
            steps.record_step(simulation.time_ns)

    def _stop(self, reason: str) -> None:
        self.paused, self.stop_reason = True, reason
        first, *lines = reason.split("\n")
        self._say("\n".join([f"{first}; the simulation is paused (/gazebo/unpause_physics tries to go on)", *lines]))
