"""Recordings of a simulation: state logs, bags and MCAP files; `LoadedSimulation.record`."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Protocol, Self

from trundle.base.diagnostics import UsageError
from trundle.base.documented import documented
from trundle.sim.simulation import Simulation, Snapshot

if TYPE_CHECKING:  # a simulation without ROS does not import its bags
    from trundle.robots.model import World
    from trundle.ros import GraphLoop


class _Writer(Protocol):
    def write(self) -> None:
        """Write what a bag received since the last call."""

    def close(self) -> None:
        """Complete the file."""


@documented("file close")
class Recording:
    """Recording of a simulation until `close`."""

    __module__ = "trundle"

    def __init__(self, file: Path, writer: _Writer, on_close: "Callable[[Recording], None]") -> None:
        """Wrap what writes the file; see `LoadedSimulation.record`."""
        self.file = file
        """Path of the recording."""
        self._writer: _Writer | None = writer
        self._on_close = on_close

    def write(self) -> None:
        """Write the messages of the last steps; for the simulation only."""
        if self._writer is not None:
            self._writer.write()

    def close(self) -> None:
        """Complete the file.

        Raises:
            UsageError: a part of it could not be written.
        """
        writer, self._writer = self._writer, None
        if writer is not None:
            self._on_close(self)
            writer.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<Recording {str(self.file)!r}{'' if self._writer is not None else ', complete'}>"


class StateLogWriter:
    """Hook that writes a state log of a world without changes of its models."""

    def __init__(self, simulation: Simulation, file: Path, world: "World") -> None:
        """Write the present state.

        Raises:
            UsageError: the file cannot be written.
        """
        from .state_logs import start_state_log

        self._simulation, self._error = simulation, ""
        try:
            self._log = start_state_log(file, simulation, world, simulation.report)
        except OSError as error:
            raise UsageError(f"{file} cannot be written: {error.strerror}") from None
        self._names = simulation.engine.compiled.link_names
        simulation.add_hook(self, period_ns=self._log.period_ns)

    def after_step(self, snapshot: Snapshot) -> None:
        """Write the state."""
        if self._error:
            return
        if self._simulation.engine.compiled.link_names != self._names:
            self._error = "models were spawned, deleted or renamed, which a state log cannot hold"
            return
        try:
            self._log.after_step(snapshot)
        except OSError as error:
            self._error = str(error.strerror)

    def write(self) -> None:
        """Do nothing: states are written when they are due."""

    def close(self) -> None:
        """Complete the file.

        Raises:
            UsageError: the recording ended early.
        """
        self._simulation.remove_hook(self)
        self._log.close()
        if self._error:
            raise UsageError(f"the recording ended early: {self._error}")


class BagWriter:
    """Writes the messages that this process publishes, in a fixed order."""

    def __init__(self, simulation: Simulation, file: Path, loop: "GraphLoop") -> None:
        """Open the file.

        Raises:
            TrundleError: it cannot be written.
        """
        from trundle.ros import StepRecorder

        self._simulation, self._loop, self._error = simulation, loop, ""
        self._bag = StepRecorder(loop, file, on_failure=self._fail)
        loop.wait_idle()

    def _fail(self, reason: str) -> None:
        self._error = reason

    def write(self) -> None:
        """Write what was received since the last call."""
        self._bag.write(self._simulation.time_ns)

    def close(self) -> None:
        """Complete the file.

        Raises:
            UsageError: the recording failed.
        """
        self.write()
        self._loop.run(self._detach())
        self._bag.close()
        if self._error:
            raise UsageError(self._error)

    async def _detach(self) -> None:
        self._bag.detach()
