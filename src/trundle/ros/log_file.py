"""Rotating log file, written by its own thread so that callers never wait for the disk."""

import threading
from pathlib import Path
from queue import Empty, SimpleQueue
from typing import BinaryIO

_MAX_LINES = 100_000
"""Capacity of the queue [lines]."""
_CLOSE_S = 1.0


class LogFile:
    """Log file with rotated backups `name.1`, `name.2`, … in its folder.

    Lines that cannot be written are dropped and counted; the next successful write reports the count.
    """

    def __init__(self, path: Path, *, max_bytes: int, backups: int) -> None:
        """Create a log; the first line opens the file for appending.

        Args:
            path: newest file.
            most_bytes: size [bytes] at which the file is rotated.
            backups: number of rotated files to keep.
        """
        self._path = path
        self._max_bytes = max_bytes
        self._backups = backups
        self._lines: SimpleQueue[str | None] = SimpleQueue()
        self._file: BinaryIO | None = None
        self.lost = 0
        """Dropped lines not yet reported."""
        self._thread = threading.Thread(target=self._run, name=f"writes {path.name}", daemon=True)
        self._thread.start()

    def write(self, text: str) -> None:
        """Queue one or more lines for writing; callable from any thread."""
        if self._lines.qsize() < _MAX_LINES:
            self._lines.put(text)
        else:
            self.lost += 1

    def close(self) -> None:
        """Write queued lines, for at most 1 s, and close."""
        self._lines.put(None)
        self._thread.join(_CLOSE_S)

    def _run(self) -> None:
        while (text := self._lines.get()) is not None:
            lines = [text]
            is_last = False
            while not is_last:
                try:
                    text = self._lines.get_nowait()
                except Empty:
                    break
                if text is None:
                    is_last = True
                else:
                    lines.append(text)
            self._write(lines)
            if is_last:
                break
        self._close()

    def _write(self, lines: list[str]) -> None:
        lost, self.lost = self.lost, 0
        if lost:
            lines = [f"{lost} lines dropped: the disk was full or too slow", *lines]
        for line in lines:
            try:
                self._append(line)
            except OSError:
                self.lost += 1
                self._close()

    def _append(self, line: str) -> None:
        if self._file is None:
            self._file = self._path.open("ab", buffering=0)
        data = memoryview(f"{line}\n".encode(errors="replace"))
        while data:
            data = data[self._file.write(data) :]
        if self._file.tell() > self._max_bytes:
            self._close()
            for number in range(self._backups - 1, -1, -1):
                older = self._backup_path(number)
                if older.exists():
                    older.replace(self._backup_path(number + 1))

    def _close(self) -> None:
        file, self._file = self._file, None
        if file is not None:
            file.close()

    def _backup_path(self, number: int) -> Path:
        return self._path if number == 0 else self._path.with_name(f"{self._path.name}.{number}")
