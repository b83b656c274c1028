"""Places of labels in a picture, so that they can be read."""

from collections.abc import Iterator, Sequence
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Rect: TypeAlias = tuple[float, float, float, float]
"""Left, top, right and bottom."""
_Rects: TypeAlias = NDArray[np.float64]
"""(rectangles, 4)"""
_RINGS = 12
_TOUCH = 2.0
"""Distance up to which a label is beside its box, in its pixels."""


def place_labels(
    boxes: Sequence[Rect], sizes: Sequence[tuple[float, float]], bounds: tuple[float, float]
) -> list[Rect]:
    """Return places in which no label covers another: at its box if there is room, over boxes as little as can be.

    Args:
        boxes: in the picture.
        sizes: width and height of each label.
        bounds: width and height of the picture.
    """
    all_boxes = np.reshape(np.array(boxes, dtype=np.float64), (-1, 4))
    areas = (all_boxes[:, 2] - all_boxes[:, 0]) * (all_boxes[:, 3] - all_boxes[:, 1])
    placed = np.zeros_like(all_boxes)  # covers nothing until it is set
    for i in np.argsort(areas, kind="stable"):
        places = _within(np.array(list(_candidates(boxes[i], sizes[i]))), bounds)
        is_apart = ~np.array([is_beside(place, boxes[i]) for place in places.tolist()])
        # The first of those that are best: lexsort is stable, and its last key decides first.
        best = np.lexsort((_covered(places, all_boxes), is_apart, _covered(places, placed)))[0]
        placed[i] = places[best]
    return [(left, top, right, bottom) for left, top, right, bottom in placed.tolist()]


def is_beside(label: Sequence[float], box: Rect) -> bool:
    """Return True if a label touches its box or lies in it."""
    return (
        label[0] <= box[2] + _TOUCH
        and label[2] >= box[0] - _TOUCH
        and label[1] <= box[3] + _TOUCH
        and label[3] >= box[1] - _TOUCH
    )


def _candidates(box: Rect, size: tuple[float, float]) -> Iterator[Rect]:
    """Yield places, the best first: above the box, below it, in it, beside it, and then farther and farther away."""
    (left, top, right, bottom), (width, height) = box, size
    for x, y in (
        (left, top - height), (left, bottom), (left, top), (left, bottom - height), (right, top), (left - width, top),
        (right, bottom - height), (left - width, bottom - height),
    ):  # fmt: skip
        yield x, y, x + width, y + height
    for ring in range(1, _RINGS + 1):
        for down in range(-ring, ring + 1):
            for across in (-ring, ring) if abs(down) < ring else range(-ring, ring + 1):
                x, y = left + across * width / 4, top - height + down * height
                yield x, y, x + width, y + height


def _within(places: _Rects, bounds: tuple[float, float]) -> _Rects:
    """Return places moved into the picture."""
    corners, sizes = places[:, :2], places[:, 2:] - places[:, :2]
    inside = np.maximum(np.minimum(corners, bounds - sizes), 0.0)
    return np.hstack((inside, inside + sizes))


def _covered(places: _Rects, others: _Rects) -> NDArray[np.float64]:
    """Return the areas that each place covers of others, added up."""
    low = np.maximum(places[:, None, :2], others[:, :2])
    high = np.minimum(places[:, None, 2:], others[:, 2:])
    return np.prod(np.maximum(high - low, 0.0), axis=2).sum(axis=1)
