"""Videos: frames of a simulation or a turntable, and their files."""

# PyAV's types are partial.
# pyright: reportUnknownMemberType=false

import math
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
from PIL import Image

from trundle.base.atomic_write import replaced_atomically
from trundle.base.diagnostics import UsageError

from .render import PictureRenderer

FRAMES_PER_S = 25
_TURN_S = 8.0
"""Time of one turn [s]."""
_PILLOW = {".webp": "WEBP", ".gif": "GIF", ".apng": "PNG"}
VIDEO_SUFFIXES = (".mp4", *_PILLOW)
"""Suffixes of video files."""


def turntable(renderer: PictureRenderer) -> Iterator[Image.Image]:
    """Yield frames of one turn around a scene at rest."""
    count = int(_TURN_S * FRAMES_PER_S)
    for i in range(count):
        yield renderer.render(turned_rad=2.0 * math.pi * i / count)


def simulated_frames(renderer: PictureRenderer, duration_s: float) -> Iterator[Image.Image]:
    """Yield frames of the simulation from now on, at real-time speed."""
    start_ns = renderer.simulation.time_ns
    for i in range(max(round(duration_s * FRAMES_PER_S), 1)):
        remaining_s = (start_ns - renderer.simulation.time_ns) * 1e-9 + i / FRAMES_PER_S
        if remaining_s > 0.0:
            renderer.simulation.run(remaining_s)
        yield renderer.render()


def write_video(frames: Iterator[Image.Image], output: Path, *, report_progress: Callable[[int], None]) -> None:
    """Write frames to a file, in the format of its suffix.

    Args:
        frames: images of equal size.
        output: path with one of `VIDEO_SUFFIXES`.
        report_progress: called with the number of written frames.

    Raises:
        UsageError: it cannot be written, or its package is not installed.
    """
    try:
        with replaced_atomically(output) as file:
            if output.suffix.lower() == ".mp4":
                _write_mp4(frames, file, report_progress)
            else:
                _write_pillow(frames, file, report_progress)
    except (OSError, ValueError) as error:
        raise UsageError(f"cannot write {output}: {getattr(error, 'strerror', None) or error}") from None


def _write_pillow(frames: Iterator[Image.Image], output: Path, report_progress: Callable[[int], None]) -> None:
    images: list[Image.Image] = []
    for frame in frames:
        images.append(frame)
        report_progress(len(images))
    first, *rest = images
    duration_ms = 1000 // FRAMES_PER_S
    first.save(output, _PILLOW[output.suffix.lower()], save_all=True, append_images=rest, duration=duration_ms, loop=0)


def _write_mp4(frames: Iterator[Image.Image], output: Path, report_progress: Callable[[int], None]) -> None:
    try:
        import av
    except ImportError:
        message = "mp4 needs the package 'av': pip install 'trundle[video]'; .webp, .apng and .gif need no package"
        raise UsageError(message) from None
    with av.open(str(output), "w", format="mp4") as container:
        stream = container.add_stream("libx264", rate=FRAMES_PER_S, options={"crf": "20"})
        stream.pix_fmt = "yuv420p"
        for done, frame in enumerate(frames, 1):
            even = np.asarray(frame.convert("RGB"))[: frame.height // 2 * 2, : frame.width // 2 * 2]
            if done == 1:
                stream.height, stream.width = even.shape[:2]
            container.mux(stream.encode(av.VideoFrame.from_ndarray(np.ascontiguousarray(even), format="rgb24")))
            report_progress(done)
        container.mux(stream.encode())
