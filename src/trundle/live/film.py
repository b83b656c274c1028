"""Videos of a simulation, written while it runs: `LoadedSimulation.film`."""

import queue
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Self

from PIL import Image

from trundle.base.diagnostics import UsageError
from trundle.base.documented import documented
from trundle.base.video_file import FRAMES_PER_S, VIDEO_SUFFIXES, write_video
from trundle.sim.simulation import Simulation, Snapshot
from trundle.spatial import NS_PER_S

_QUEUED = 8
"""Maximum number of frames that wait for the encoder, which bounds the memory."""


@documented("file frame_count close")
class Film:
    """Video of 25 frames per second of simulation time; `close` completes the file."""

    __module__ = "trundle"

    def __init__(self, simulation: Simulation, file: Path, draw: Callable[[Snapshot], Image.Image]) -> None:
        """Begin with the present state; see `LoadedSimulation.film`."""
        if file.suffix.lower() not in VIDEO_SUFFIXES:
            raise UsageError(f"a video's file ends in {', '.join(VIDEO_SUFFIXES)}, not in {file.suffix!r}")
        self.file = file
        """Path of the video; the file is complete after `close`."""
        self._simulation, self._draw = simulation, draw
        self._frames: queue.Queue[Image.Image | None] = queue.Queue(_QUEUED)
        self._error: Exception | None = None
        self._is_open = True
        self.frame_count = 0
        """Number of frames so far."""
        self._thread = threading.Thread(target=self._write, name="trundle-film", daemon=True)
        self._thread.start()
        self.after_step(simulation.snapshot())
        simulation.add_hook(self, period_ns=NS_PER_S // FRAMES_PER_S)

    def after_step(self, snapshot: Snapshot) -> None:
        """Add a frame; for the simulation only."""
        if self._error is None:
            self.frame_count += 1
            self._frames.put(self._draw(snapshot))

    def _write(self) -> None:
        try:
            write_video(self._queued(), self.file, report_progress=lambda _: None)
        except Exception as error:  # `close` raises it on the program's thread
            self._error = error
            while self._frames.get() is not None:  # empties the queue, so that no call blocks in put
                pass

    def _queued(self) -> Iterator[Image.Image]:
        while (frame := self._frames.get()) is not None:
            yield frame

    def close(self) -> None:
        """End the video.

        Raises:
            UsageError: it cannot be written, or a package is missing.
        """
        if not self._is_open:
            return
        self._is_open = False
        self._simulation.remove_hook(self)
        self._frames.put(None)
        self._thread.join()
        if self._error is not None:
            raise self._error

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<Film {str(self.file)!r}: {self.frame_count} frames>"
