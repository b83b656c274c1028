"""Terminal of a program: its recent output, and keys for it; for a process, with a pseudo-terminal."""

import asyncio
import os
import re
from collections.abc import Callable
from pathlib import Path

from .job import JobError

HAS_PSEUDO_TERMINALS = hasattr(os, "openpty")
"""True if this system has pseudo-terminals; Windows has none."""
LEADER = Path(__file__).with_name("session_leader.py")
"""Program that makes standard input its session's terminal, then becomes the program of its arguments."""
MAX_SIZE = 500
"""Maximum of columns or rows."""

_SCROLLBACK_BYTES = 256 * 1024
_CHUNK_BYTES = 64 * 1024
_PERIOD_S = 1 / 30
"""Time between two chunks of output [s], so that a program that prints without end blocks, as at every terminal."""
_KEY_BYTES = 64 * 1024
"""Maximum of queued keys for a program that reads none; further ones are lost."""
_MIN_SIZE = 2
_CUT_BYTES = 4096
"""Distance [bytes] within which the oldest output is cut at a line end, so that no escape sequence is cut."""
_LEAVE_MODES = "\x18\x1b[?1049l\x1b[?1000l\x1b[?1002l\x1b[?1003l\x1b[?1006l\x1b[?2004l\x1b[!p"
"""Escape sequences that reset modes that a program may have left: alternate screen, mouse, paste, attributes."""
_CONTROLS = re.compile(
    r"\x1b\[[0-?]*[ -/]*[@-~]|\x1b[\]P^_X][^\x07\x1b]*(?:\x07|\x1b\\)?|\x1b[ -/]*[0-~]|[\x00-\x08\x0b-\x1f\x7f-\x9f]"
)
"""Pattern of escape sequences (ECMA-48, 5.4 and 5.6), and of control characters other than tab and newline."""


class Terminal:
    """Recent output of consecutive programs; used on one asyncio loop.

    Keys go to the listener, else to the process at the pseudo-terminal.
    """

    def __init__(self) -> None:
        self.columns, self.rows = 80, 24
        self.ended: str | None = None
        """Message about the program's end; None: it runs."""
        self.changes = 0
        """Number of changes of the displayed state."""
        self._output = bytearray()
        self._first = 0
        self._descriptor: int | None = None
        """File of this process at the pseudo-terminal; None: there is none."""
        self._keys = bytearray()
        self._listener: Callable[[str], None] | None = None

    # -- output

    @property
    def first(self) -> int:
        """Offset of the scrollback's first byte in the whole output."""
        return self._first

    @property
    def scrollback(self) -> bytes:
        """Recent output, with its escape sequences."""
        return bytes(self._output)

    def last_lines(self, count: int) -> list[str]:
        """Return the last lines that are not blank, without control characters."""
        end = self._output[-_CUT_BYTES:].decode(errors="replace").replace("\r\n", "\n")
        lines = (line.rpartition("\r")[2].rstrip() for line in _CONTROLS.sub(_keep_return, end).split("\n"))
        return [line for line in lines if line][-count:]

    def write(self, text: str) -> None:
        """Print a text with newlines as line ends."""
        self._append(text.replace("\n", "\r\n").encode())

    def begin(self) -> None:
        """Mark the program as running."""
        self.ended = None
        self.changes += 1

    def end(self, sentence: str) -> None:
        """Reset the program's terminal modes, and print how it ended."""
        self.ended = sentence
        self.write(f"{_LEAVE_MODES}\n\x1b[2m{_CONTROLS.sub('', sentence)}\x1b[22m\n")

    def _append(self, data: bytes) -> None:
        self._output += data
        self.changes += 1
        if (surplus := len(self._output) - _SCROLLBACK_BYTES) > 0:
            line_end = self._output.find(b"\n", surplus, surplus + _CUT_BYTES)
            surplus = line_end + 1 if line_end >= 0 else surplus
            del self._output[:surplus]
            self._first += surplus

    # -- keys and size

    def type(self, text: str) -> None:
        """Send keys to the program, encoded as terminals do."""
        if self._listener is not None:
            self._listener(text)
        elif self._descriptor is not None:
            self._keys += text.encode(errors="replace")[: _KEY_BYTES - len(self._keys)]
            self._write_keys()

    def listen(self, listener: Callable[[str], None] | None) -> None:
        """Set the function that receives the keys; None: the process receives them."""
        self._listener = listener

    def resize(self, columns: int, rows: int) -> None:
        """Set the size, clamped to the limits."""
        columns, rows = (min(max(size, _MIN_SIZE), MAX_SIZE) for size in (columns, rows))
        if (columns, rows) != (self.columns, self.rows):
            self.columns, self.rows = columns, rows
            self.changes += 1
            self._set_size()

    # -- a process

    def open(self) -> int:
        """Open a pseudo-terminal for a process; return the process's descriptor, which the caller closes.

        Raises:
            JobError: the system has no pseudo-terminal left.
        """
        try:
            self._descriptor, process_descriptor = os.openpty()
        except OSError as error:
            raise JobError(f"no terminal can be opened: {error.strerror}") from None
        os.set_blocking(self._descriptor, False)
        self._set_size()
        asyncio.get_running_loop().add_reader(self._descriptor, self._read)
        return process_descriptor

    def close(self) -> None:
        """Read the rest of the output and close the pseudo-terminal; its processes get SIGHUP."""
        if (descriptor := self._descriptor) is None:
            return
        for _ in range(_SCROLLBACK_BYTES // _CHUNK_BYTES):
            if not self._read_chunk(descriptor):
                break
        loop = asyncio.get_running_loop()
        loop.remove_reader(descriptor)
        loop.remove_writer(descriptor)
        self._descriptor = None
        self._keys.clear()
        os.close(descriptor)

    def _read(self) -> None:
        descriptor, loop = self._descriptor, asyncio.get_running_loop()
        assert descriptor is not None, "the pseudo-terminal is open"
        loop.remove_reader(descriptor)
        if self._read_chunk(descriptor):
            loop.call_later(_PERIOD_S, self._resume_reading, descriptor)

    def _resume_reading(self, descriptor: int) -> None:
        if self._descriptor == descriptor:
            asyncio.get_running_loop().add_reader(descriptor, self._read)

    def _read_chunk(self, descriptor: int) -> bool:
        """Read output of the process; return False if no process is left."""
        data, is_left = b"", True
        try:
            while len(data) < _CHUNK_BYTES and (more := os.read(descriptor, _CHUNK_BYTES - len(data))):
                data += more
        except BlockingIOError:
            pass
        except OSError:
            is_left = False
        if data:
            self._append(data)
        return is_left or bool(data)

    def _write_keys(self) -> None:
        loop, descriptor = asyncio.get_running_loop(), self._descriptor
        assert descriptor is not None, "the pseudo-terminal is open"
        try:
            del self._keys[: os.write(descriptor, self._keys)]
        except BlockingIOError:
            pass
        except OSError:  # no process is left
            self._keys.clear()
        if self._keys:
            loop.add_writer(descriptor, self._write_keys)
        else:
            loop.remove_writer(descriptor)

    def _set_size(self) -> None:
        if self._descriptor is not None:
            import termios  # Windows has no pseudo-terminals

            termios.tcsetwinsize(self._descriptor, (self.rows, self.columns))


def _keep_return(match: re.Match[str]) -> str:
    return "\r" if match[0] == "\r" else ""
