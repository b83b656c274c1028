"""A terminal of our own: the end of what its program printed, and keys for it; for a process, a pseudo-terminal."""

import asyncio
import os
import re
from collections.abc import Callable
from pathlib import Path

from .job import JobError

HAS_PSEUDO_TERMINALS = hasattr(os, "openpty")
"""False on Windows."""
LEADER = Path(__file__).with_name("session_leader.py")
"""Program that makes its standard input the session's terminal, and becomes the program of its arguments."""
MAX_SIZE = 500
"""Columns or rows."""

_SCROLLBACK_BYTES = 256 * 1024
_CHUNK_BYTES = 64 * 1024
_PERIOD_S = 1 / 30
"""Time between two chunks [s]: a program that prints without end waits, as at every terminal."""
_KEY_BYTES = 64 * 1024
"""Keys that wait for a program that reads none; further ones are lost."""
_MIN_SIZE = 2
_CUT_BYTES = 4096
"""The oldest output is cut behind a line's end, if one is as near as this: not inside an escape sequence."""
_LEAVE_MODES = "\x18\x1b[?1049l\x1b[?1000l\x1b[?1002l\x1b[?1003l\x1b[?1006l\x1b[?2004l\x1b[!p"
"""Ends what a program may have left: a sequence, the alternate screen, reports of mouse and paste, attributes."""
_CONTROLS = re.compile(
    r"\x1b\[[0-?]*[ -/]*[@-~]|\x1b[\]P^_X][^\x07\x1b]*(?:\x07|\x1b\\)?|\x1b[ -/]*[0-~]|[\x00-\x08\x0b-\x1f\x7f-\x9f]"
)
"""Escape sequences (ECMA-48, 5.4 and 5.6) and control characters but tab and newline."""


class Terminal:
    """End of the output of one program after another; used on one asyncio loop.

    The keys go to the function that listens, else to the process at the pseudo-terminal.
    """

    def __init__(self) -> None:
        self.columns, self.rows = 80, 24
        self.ended: str | None = None
        """Sentence on the end of its program; None: it runs."""
        self.changes = 0
        """Grows with everything that changes what is shown."""
        self._shown = bytearray()
        self._first = 0
        self._descriptor: int | None = None
        """Our side of the pseudo-terminal; None: there is none."""
        self._keys = bytearray()
        self._listener: Callable[[str], None] | None = None

    # -- what is shown

    @property
    def first(self) -> int:
        """Number of the scrollback's first byte, of all that were printed."""
        return self._first

    @property
    def scrollback(self) -> bytes:
        """Newest output, with its escape sequences."""
        return bytes(self._shown)

    def last_lines(self, count: int) -> list[str]:
        """Return the last lines that are not blank, without control characters."""
        end = self._shown[-_CUT_BYTES:].decode(errors="replace").replace("\r\n", "\n")
        lines = (line.rpartition("\r")[2].rstrip() for line in _CONTROLS.sub(_keep_return, end).split("\n"))
        return [line for line in lines if line][-count:]

    def write(self, text: str) -> None:
        """Print a text, whose lines end with a newline."""
        self._append(text.replace("\n", "\r\n").encode())

    def begin(self) -> None:
        """Note that the program runs."""
        self.ended = None
        self.changes += 1

    def end(self, sentence: str) -> None:
        """Note and print how the program ended, after what it left is undone."""
        self.ended = sentence
        self.write(f"{_LEAVE_MODES}\n\x1b[2m{_CONTROLS.sub('', sentence)}\x1b[22m\n")

    def _append(self, data: bytes) -> None:
        self._shown += data
        self.changes += 1
        if (surplus := len(self._shown) - _SCROLLBACK_BYTES) > 0:
            line_end = self._shown.find(b"\n", surplus, surplus + _CUT_BYTES)
            surplus = line_end + 1 if line_end >= 0 else surplus
            del self._shown[:surplus]
            self._first += surplus

    # -- keys and size

    def type(self, text: str) -> None:
        """Give keys to the program, as the terminal sends them."""
        if self._listener is not None:
            self._listener(text)
        elif self._descriptor is not None:
            self._keys += text.encode(errors="replace")[: _KEY_BYTES - len(self._keys)]
            self._write_keys()

    def listen(self, listener: Callable[[str], None] | None) -> None:
        """Call a function with the keys; None: they are lost, or go to the process."""
        self._listener = listener

    def resize(self, columns: int, rows: int) -> None:
        """Change the size, within bounds."""
        columns, rows = (min(max(size, _MIN_SIZE), MAX_SIZE) for size in (columns, rows))
        if (columns, rows) != (self.columns, self.rows):
            self.columns, self.rows = columns, rows
            self.changes += 1
            self._set_size()

    # -- a process

    def open(self) -> int:
        """Open a pseudo-terminal for a process; return its descriptor of the other side, which the caller closes.

        Raises:
            JobError: the system has none left.
        """
        try:
            self._descriptor, theirs = os.openpty()
        except OSError as error:
            raise JobError(f"no terminal can be opened: {error.strerror}") from None
        os.set_blocking(self._descriptor, False)
        self._set_size()
        asyncio.get_running_loop().add_reader(self._descriptor, self._read)
        return theirs

    def close(self) -> None:
        """Show the rest of the output and close the pseudo-terminal; its processes hang up."""
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
        assert descriptor is not None, "a closed terminal is not read"
        loop.remove_reader(descriptor)
        if self._read_chunk(descriptor):
            loop.call_later(_PERIOD_S, self._read_on, descriptor)

    def _read_on(self, descriptor: int) -> None:
        if self._descriptor == descriptor:
            asyncio.get_running_loop().add_reader(descriptor, self._read)

    def _read_chunk(self, descriptor: int) -> bool:
        """Read what the process printed; False if no process is left."""
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
        assert descriptor is not None, "keys are for a process"
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
            import termios  # Windows has none

            termios.tcsetwinsize(self._descriptor, (self.rows, self.columns))


def _keep_return(found: re.Match[str]) -> str:
    return "\r" if found[0] == "\r" else ""
