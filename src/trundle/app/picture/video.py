"""Frames of videos: a simulation, or a turntable."""

import math
from collections.abc import Iterator

from PIL import Image

from trundle.base.video_file import FRAMES_PER_S

from .render import PictureRenderer

_TURN_S = 8.0
"""Time of one turn [s]."""


def turntable(renderer: PictureRenderer) -> Iterator[Image.Image]:
    """Yield frames of one turn around a scene at rest."""
    count = int(_TURN_S * FRAMES_PER_S)
    for i in range(count):
        yield renderer.render(turned_rad=2.0 * math.pi * i / count)


def simulated_frames(renderer: PictureRenderer, duration_s: float) -> Iterator[Image.Image]:
    """Yield frames of the simulation from now on, at real-time speed."""
    renderer.include_motion(duration_s)
    start_ns = renderer.simulation.time_ns
    for i in range(max(round(duration_s * FRAMES_PER_S), 1)):
        remaining_s = (start_ns - renderer.simulation.time_ns) * 1e-9 + i / FRAMES_PER_S
        if remaining_s > 0.0:
            renderer.simulation.run(remaining_s)
        yield renderer.render()
