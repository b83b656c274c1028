"""Layout of labels in a picture without overlaps."""

from collections.abc import Iterator, Sequence
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Rect: TypeAlias = tuple[float, float, float, float]
"""Left, top, right and bottom."""
_Rects: TypeAlias = NDArray[np.float64]
"""(rectangles, 4)"""
_RINGS = 12
_TOUCHING_PX = 2.0
"""Maximum distance at which a label touches its box."""


def layout_labels(
    boxes: Sequence[Rect], sizes: Sequence[tuple[float, float]], bounds: tuple[float, float]
) -> list[Rect]:
    """Return the rectangles of labels: without overlaps, at their boxes if there is room, covering few other boxes.

    Args:
        boxes: labelled boxes.
        sizes: width and height of each label.
        bounds: width and height of the picture.
    """
    all_boxes = np.reshape(np.array(boxes, dtype=np.float64), (-1, 4))
    areas = (all_boxes[:, 2] - all_boxes[:, 0]) * (all_boxes[:, 3] - all_boxes[:, 1])
    placed = np.zeros_like(all_boxes)  # empty rectangles, so that labels not placed yet cover nothing
    for i in np.argsort(areas, kind="stable"):
        candidates = _within(np.array(list(_candidates(boxes[i], sizes[i]))), bounds)
        is_detached = ~np.array([touches_box(candidate, boxes[i]) for candidate in candidates.tolist()])
        # First of the best candidates: lexsort is stable, and its last key is the primary one.
        best = np.lexsort((_covered(candidates, all_boxes), is_detached, _covered(candidates, placed)))[0]
        placed[i] = candidates[best]
    return [(left, top, right, bottom) for left, top, right, bottom in placed.tolist()]


def touches_box(label: Sequence[float], box: Rect) -> bool:
    """True if a label touches its box or is inside it."""
    return (
        label[0] <= box[2] + _TOUCHING_PX
        and label[2] >= box[0] - _TOUCHING_PX
        and label[1] <= box[3] + _TOUCHING_PX
        and label[3] >= box[1] - _TOUCHING_PX
    )


def _candidates(box: Rect, size: tuple[float, float]) -> Iterator[Rect]:
    """Yield rectangles, best first: above the box, below, inside, beside it, and then at growing distances."""
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


def _within(labels: _Rects, bounds: tuple[float, float]) -> _Rects:
    """Return rectangles moved into the picture."""
    corners, sizes = labels[:, :2], labels[:, 2:] - labels[:, :2]
    inside = np.maximum(np.minimum(corners, bounds - sizes), 0.0)
    return np.hstack((inside, inside + sizes))


def _covered(labels: _Rects, others: _Rects) -> NDArray[np.float64]:
    """Return the total area of other rectangles that each label covers."""
    low = np.maximum(labels[:, None, :2], others[:, :2])
    high = np.minimum(labels[:, None, 2:], others[:, 2:])
    return np.prod(np.maximum(high - low, 0.0), axis=2).sum(axis=1)
