"""Pictures of a video file."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True)
class Frame:
    """A picture and its time."""

    time_s: float
    picture: NDArray[np.uint8]
    """(height, width, 3) RGB."""


def read_video(file: Path) -> list[Frame]:
    """Decode all pictures of a video."""
    av = pytest.importorskip("av", reason="av, which reads videos, is not installed: pip install av")
    with av.open(str(file)) as video:
        return [Frame(float(frame.time), frame.to_ndarray(format="rgb24")) for frame in video.decode(video=0)]
