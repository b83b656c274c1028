"""Bags in binary streams, through a temporary file."""

import shutil
import tempfile
from pathlib import Path
from typing import BinaryIO


class SpooledStream:
    """Temporary file with a stream's content; a changed file is copied to the stream on close."""

    def __init__(self, stream: BinaryIO, mode: str) -> None:
        self._stream = stream
        self._mode = mode
        self._folder = tempfile.TemporaryDirectory(prefix="rosbag_")
        self.path = Path(self._folder.name) / "stream.bag"
        if mode in ("r", "a"):
            stream.seek(0)
            with self.path.open("wb") as file:
                shutil.copyfileobj(stream, file)

    def close(self) -> None:
        """Copy to the stream, and remove the file."""
        if self._mode != "r":
            self._stream.seek(0)
            with self.path.open("rb") as file:
                shutil.copyfileobj(file, self._stream)
            self._stream.flush()
        self._folder.cleanup()
