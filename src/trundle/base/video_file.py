"""Files of videos: frames in order, at a constant rate."""

# For pyright: PyAV's types are incomplete.
# pyright: reportUnknownMemberType=false

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from trundle.base.atomic_write import replaced_atomically
from trundle.base.diagnostics import UsageError

if TYPE_CHECKING:
    from PIL import Image

FRAMES_PER_S = 25
_PILLOW = {".webp": "WEBP", ".gif": "GIF", ".apng": "PNG"}
VIDEO_SUFFIXES = (".mp4", *_PILLOW)
"""Suffixes of video files."""


def write_video(frames: "Iterable[Image.Image]", output: Path, *, report_progress: Callable[[int], None]) -> None:
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


def _write_pillow(frames: "Iterable[Image.Image]", output: Path, report_progress: Callable[[int], None]) -> None:
    images: list[Image.Image] = []
    for frame in frames:
        images.append(frame)
        report_progress(len(images))
    first, *rest = images
    duration_ms = 1000 // FRAMES_PER_S
    first.save(output, _PILLOW[output.suffix.lower()], save_all=True, append_images=rest, duration=duration_ms, loop=0)


def _write_mp4(frames: "Iterable[Image.Image]", output: Path, report_progress: Callable[[int], None]) -> None:
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
