"""Job in a child process, which leads a process group."""

import asyncio
import contextlib
import os
import shutil
import signal
import subprocess
import sys
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Literal

from .job import JobError, StopTimeouts
from .process_tree import ProcessTree
from .terminal import LEADER, Terminal

_POSIX = os.name == "posix"
_CHUNK_BYTES = 65536
_MAX_LINE = 10_000
"""Maximum length of a line [characters]: some programs never end one."""
_MAX_LINES = 10
_EXIT_GRACE_S = 1.0
"""Timeout for the last output after a program's end [s]: its child may hold the pipe open."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ProcessCommand:
    """A program with its environment and output settings."""

    name: str
    argv: tuple[str, ...]
    env: Mapping[str, str]
    """Complete environment; nothing is inherited."""
    cwd: Path | None = None
    output: "Literal['screen', 'log', 'inherited'] | Terminal" = "log"
    """Destination of standard output; standard error goes to the screen, as in roslaunch.

    A `Terminal` or 'inherited', this process's own streams, is used for all three standard streams.
    """
    log_file: Path | None = None
    """Log file for `output` 'log'; None drops the output."""
    reads_input: bool = False
    """True: the program reads this process's standard input, like all programs of roslaunch."""


class ProcessJob:
    """Runs a program; its lines go to `show` or to its log file."""

    def __init__(self, command: ProcessCommand, show: Callable[[str, str], None], *, tree: ProcessTree) -> None:
        """Create; `start` runs the program.

        Args:
            command: program to run.
            show: called with the job's name and each line, without newline.
            tree: process tree that kills the process and its descendants at the end.
        """
        self.name = command.name
        self._command = command
        self._tree = tree
        self._show = show
        self._process: asyncio.subprocess.Process | None = None
        self._readers: list[asyncio.Task[None]] = []
        self._last: deque[str] = deque(maxlen=_MAX_LINES)

    async def start(self) -> str:
        command = self._command
        self._last.clear()
        self._tree.watch()
        stdin = None if command.reads_input else subprocess.DEVNULL
        if isinstance(command.output, Terminal):
            process = await self._start_in(command.output)
        elif command.output == "inherited":
            process = await self._execute(command.argv, None, None)
        else:
            process = await self._execute(command.argv, stdin, subprocess.PIPE)
        self._process = process
        self._tree.add(process.pid)
        streams = ((process.stdout, command.output == "screen"), (process.stderr, True))
        self._readers = [
            asyncio.create_task(self._read(stream, to_screen=to_screen))
            for stream, to_screen in streams
            if stream is not None
        ]
        return f"with pid [{process.pid}]"

    async def _start_in(self, terminal: Terminal) -> asyncio.subprocess.Process:
        """Start the program in a terminal, whose session it leads."""
        command = self._command
        program = command.argv[0]
        if shutil.which(program, path=command.env.get("PATH", os.defpath)) is None:
            raise JobError(f"{program!r} does not exist, or cannot be run")
        descriptor = terminal.open()
        try:
            return await self._execute((sys.executable, "-I", "-S", str(LEADER), *command.argv), descriptor, descriptor)
        except JobError:
            terminal.close()
            raise
        finally:
            os.close(descriptor)

    async def _execute(self, argv: Sequence[str], stdin: int | None, output: int | None) -> asyncio.subprocess.Process:
        """Start a program; the descriptors are those of `subprocess`."""
        command = self._command
        try:
            return await asyncio.create_subprocess_exec(
                *argv,
                env=self._tree.environment(command.env),
                cwd=command.cwd,
                stdin=stdin,
                stdout=output,
                stderr=output,
                start_new_session=_POSIX,
            )
        except FileNotFoundError as error:
            raise JobError(f"{error.filename or argv[0]!r} does not exist") from None
        except (OSError, ValueError) as error:
            raise JobError(f"{argv[0]!r} cannot be run: {error}") from None

    async def wait(self) -> int:
        assert self._process is not None, "start() comes before wait()"
        code = await self._process.wait()
        if self._readers:
            _, late = await asyncio.wait(self._readers, timeout=_EXIT_GRACE_S)
            for reader in late:
                reader.cancel()
        if isinstance(self._command.output, Terminal):
            self._command.output.close()
            self._last.extend(self._command.output.last_lines(_MAX_LINES))
        self._tree.discard(self._process.pid)
        return code

    async def stop(self, timeouts: StopTimeouts) -> None:
        process = self._process
        if process is None or process.returncode is not None:
            return
        for number, timeout_s in (
            (signal.SIGINT if _POSIX else signal.SIGTERM, timeouts.interrupt_s),
            (signal.SIGTERM, timeouts.terminate_s),
        ):
            if process.returncode is not None:
                break
            self._signal(process, number)
            with contextlib.suppress(TimeoutError):
                await asyncio.wait_for(process.wait(), timeout_s)
        # Children may have outlived the group's leader.
        self._signal(process, signal.SIGKILL if _POSIX else signal.SIGTERM)
        await process.wait()

    def last_output(self) -> list[str]:
        return list(self._last)

    @staticmethod
    def _signal(process: asyncio.subprocess.Process, number: signal.Signals) -> None:
        with contextlib.suppress(ProcessLookupError, PermissionError):
            if _POSIX:
                os.killpg(process.pid, number)
            else:
                process.terminate()

    async def _read(self, stream: asyncio.StreamReader, *, to_screen: bool) -> None:
        """Read a stream; a program that writes faster than the screen blocks, which bounds the memory."""
        with contextlib.ExitStack() as stack:
            log: IO[str] | None = None
            if not to_screen and self._command.log_file is not None:
                log = stack.enter_context(self._command.log_file.open("a", encoding="utf-8", errors="replace"))
            rest = ""
            while chunk := await stream.read(_CHUNK_BYTES):
                *lines, rest = (rest + chunk.decode(errors="replace")).split("\n")
                if len(rest) > _MAX_LINE:
                    lines, rest = [*lines, rest], ""
                for line in lines:
                    self._handle_line(line, log, to_screen=to_screen)
            if rest:
                self._handle_line(rest, log, to_screen=to_screen)

    def _handle_line(self, line: str, log: IO[str] | None, *, to_screen: bool) -> None:
        line = line.rstrip("\r")
        self._last.append(line[:_MAX_LINE])
        if to_screen:
            self._show(self.name, line)
        elif log is not None:
            log.write(line + "\n")
            log.flush()
