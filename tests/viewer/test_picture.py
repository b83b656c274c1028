"""Camera messages of the usual encodings become pictures; odd ones become nothing."""

import numpy as np
import pytest

from trundle.viewer.picture import rgb_of

_RED = (200, 30, 10)


@pytest.mark.parametrize(
    ("encoding", "pixel"), [("rgb8", (200, 30, 10)), ("bgr8", (10, 30, 200)), ("rgba8", (200, 30, 10, 255))]
)
def test_colours_arrive_whatever_their_order_and_padding(encoding: str, pixel: tuple[int, ...]) -> None:
    row = bytes(pixel) * 4 + b"pad"

    rgb = rgb_of(row * 2, encoding=encoding, height=2, width=4, step=len(row))

    assert rgb is not None
    assert rgb.shape == (2, 4, 3)
    assert (rgb == _RED).all()


def test_a_depth_is_stretched_over_the_values_it_holds() -> None:
    depths = np.array([[1.0, 2.0], [np.nan, 3.0]], dtype=np.float32)

    rgb = rgb_of(depths.tobytes(), encoding="32FC1", height=2, width=2, step=8)

    assert rgb is not None
    assert rgb[..., 0].tolist() == [[0, 127], [0, 255]]


@pytest.mark.parametrize(
    ("encoding", "step", "size"), [("yuv422", 8, 16), ("rgb8", 12, 23), ("rgb8", 11, 22), ("32FC1", 4, 8)]
)
def test_what_cannot_be_a_picture_is_none(encoding: str, step: int, size: int) -> None:
    assert rgb_of(bytes(size), encoding=encoding, height=2, width=4, step=step) is None
