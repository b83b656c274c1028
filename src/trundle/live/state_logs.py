"""State logs of a simulation, for `trundle play`."""

import itertools
from collections.abc import Callable
from datetime import datetime
from pathlib import Path

from trundle.base.diagnostics import Diagnostics, UsageError
from trundle.robots.description import write_sdf, written_uri
from trundle.robots.model import World
from trundle.sim.simulation import Simulation, Snapshot, StateRecorder


def start_state_log(path: Path, simulation: Simulation, world: World, report: Diagnostics) -> StateRecorder:
    """Start a log with the current state; `trundle play` shows `world`.

    Raises:
        OSError: it cannot be written.
    """
    compiled = simulation.engine.compiled
    sdf = write_sdf(world, is_world=True, uri_of=written_uri, report=report)
    recorder = StateRecorder(path, links=compiled.link_names, joints=compiled.joint_names, sdf=sdf)
    recorder.after_step(simulation.snapshot())
    return recorder


class WorldRecorder:
    """Hook that logs a world until a write fails; each change of its models starts the next file."""

    period_ns = StateRecorder.period_ns

    def __init__(self, simulation: Simulation, file: Path, say: Callable[[str], None]) -> None:
        """Record into `file`, such as `run.log`, then into `run-2.log` and so on.

        Args:
            simulation: simulation to record.
            file: its folder is created if needed; files of earlier recordings are overwritten.
            say: prints each file's path, and a failed write.
        """
        self._simulation = simulation
        self._file = file
        self._say = say
        self._files = 0
        self._names: object = None
        self._recorder: StateRecorder | None = None
        self.has_failed = False
        """True after a failed write; no more is written."""

    def start(self, world: World) -> None:
        """Start the first file with the current state; `trundle play` shows `world`.

        Raises:
            OSError: it cannot be written.
        """
        self._names = self._present_names()
        self._files = 1
        self._recorder = start_state_log(self._file, self._simulation, world, self._simulation.report)

    def after_step(self, snapshot: Snapshot) -> None:
        """Write the state, unless a write has failed."""
        if self.has_failed:
            return
        names = self._present_names()
        try:
            if names != self._names:
                self._names = names
                self._begin()
            elif self._recorder is not None:
                self._recorder.after_step(snapshot)
        except OSError as error:
            self.has_failed = True
            self.close()
            reason = f"{error.filename or self._file}: {error.strerror}"
            self._say(f"recording failed: {reason}; trundle play shows what was recorded")

    def close(self) -> None:
        """Close the file."""
        if self._recorder is not None:
            self._recorder.close()
            self._recorder = None

    @property
    def is_recording(self) -> bool:
        """True while a file is open."""
        return self._recorder is not None

    def _present_names(self) -> tuple[tuple[str, ...], tuple[str, ...]]:
        compiled = self._simulation.engine.compiled
        return compiled.link_names, compiled.joint_names

    def _begin(self) -> None:
        self.close()
        self._files += 1
        file = self._file
        file.parent.mkdir(parents=True, exist_ok=True)
        path = file if self._files == 1 else file.with_stem(f"{file.stem}-{self._files}")
        simulation = self._simulation
        self._recorder = start_state_log(path, simulation, simulation.world, simulation.report)
        self._say(f"recording into {path}; trundle play shows it")


class PageRecording:
    """Recordings started and ended at the page, each into a new folder."""

    def __init__(self, simulation: Simulation, say: Callable[[str], None]) -> None:
        """Prepare.

        Args:
            simulation: simulation to record.
            say: prints the files' paths.
        """
        self._simulation = simulation
        self._say = say
        self._recorder: WorldRecorder | None = None
        self._since_ns = 0

    @property
    def since_ns(self) -> int | None:
        """Start of the recording [ns]; None: nothing is recorded."""
        recorder = self._recorder
        return self._since_ns if recorder is not None and recorder.is_recording else None

    def set(self, on: bool) -> None:
        """Start or end a recording in `recorded/<date and time>` below the working directory.

        Raises:
            UsageError: it cannot be written.
        """
        if on == (self.since_ns is not None):
            return
        if self._recorder is not None:
            self._simulation.remove_hook(self._recorder)
            self._recorder.close()
            self._recorder = None
        if on:
            folder = _make_folder()
            recorder = self._recorder = WorldRecorder(self._simulation, folder / "state.log", self._say)
            self._since_ns = self._simulation.time_ns
            recorder.after_step(self._simulation.snapshot())
            if not recorder.is_recording:
                self._recorder = None
                raise UsageError(f"{folder} cannot be written")
            self._simulation.add_hook(recorder, period_ns=recorder.period_ns)

    def follow(self) -> None:
        """Continue after a jump in simulation time."""
        if self._recorder is not None:
            self._simulation.remove_hook(self._recorder)
            self._simulation.add_hook(self._recorder, period_ns=self._recorder.period_ns)


def _make_folder() -> Path:
    """Create a folder named after the date and time.

    Raises:
        UsageError: it cannot be created.
    """
    name = datetime.now().strftime("%Y-%m-%d_%H-%M-%S")
    numbered = (Path("recorded", f"{name}-{number}") for number in itertools.count(2))
    for folder in itertools.chain((Path("recorded", name),), numbered):
        try:
            folder.mkdir(parents=True)
        except OSError as error:
            if not folder.exists():
                raise UsageError(f"{folder} cannot be written: {error.strerror}") from None
        else:
            return folder
    raise AssertionError
