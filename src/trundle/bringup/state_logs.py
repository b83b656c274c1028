"""State logs of a simulation, for `trundle play`."""

from collections.abc import Callable
from pathlib import Path

from trundle.description import write_sdf, written_uri
from trundle.diagnostics import Diagnostics
from trundle.model import World
from trundle.simulation import Simulation, Snapshot, StateRecorder


def start_state_log(path: Path, simulation: Simulation, world: World, report: Diagnostics) -> StateRecorder:
    """Start a log with the current state; `world` is the one that `trundle play` will show.

    Raises:
        OSError: it cannot be written.
    """
    compiled = simulation.engine.compiled
    sdf = write_sdf(world, is_world=True, uri_of=written_uri, report=report)
    recorder = StateRecorder(path, links=compiled.link_names, joints=compiled.joint_names, sdf=sdf)
    recorder.after_step(simulation.snapshot())
    return recorder


class RunRecorder:
    """Hook that logs a run until a write fails."""

    period_ns = StateRecorder.period_ns

    def __init__(self, recorder: StateRecorder, say: Callable[[str], None]) -> None:
        self._recorder = recorder
        self._say = say
        self.has_failed = False
        """True after a failed write; no more is written."""

    def after_step(self, snapshot: Snapshot) -> None:
        """Write the state, unless a write has failed."""
        if self.has_failed:
            return
        try:
            self._recorder.after_step(snapshot)
        except OSError as error:
            self._say(f"recording failed: {error.filename}: {error.strerror}; trundle play shows what was recorded")
            self.has_failed = True

    def close(self) -> None:
        """Close the file."""
        self._recorder.close()


class WorldRecorder:
    """Hook that logs a world whose models come and go; each change starts the next file."""

    period_ns = StateRecorder.period_ns

    def __init__(self, simulation: Simulation, folder: Path, say: Callable[[str], None]) -> None:
        """Record into `state.log`, then `state-2.log` and so on.

        Args:
            simulation: the one to record.
            folder: is made; files of earlier recordings are overwritten.
            say: prints each file, and a failed write.
        """
        self._simulation = simulation
        self._folder = folder
        self._say = say
        self._files = 0
        self._names: object = None
        self._recorder: StateRecorder | None = None

    def after_step(self, snapshot: Snapshot) -> None:
        """Write the state."""
        compiled = self._simulation.engine.compiled
        names = (compiled.link_names, compiled.joint_names)
        try:
            if names != self._names:
                self._names = names
                self._begin()
            elif self._recorder is not None:
                self._recorder.after_step(snapshot)
        except OSError as error:
            self.close()
            self._say(f"recording ends: {self._folder}: {error.strerror}")

    def close(self) -> None:
        """Close the file."""
        if self._recorder is not None:
            self._recorder.close()
            self._recorder = None

    def _begin(self) -> None:
        self.close()
        self._files += 1
        self._folder.mkdir(parents=True, exist_ok=True)
        path = self._folder / ("state.log" if self._files == 1 else f"state-{self._files}.log")
        simulation = self._simulation
        self._recorder = start_state_log(path, simulation, simulation.world, simulation.report)
        self._say(f"recording into {path}; trundle play shows it")
