"""Places of labels in a picture, so that they can be read."""

from collections.abc import Iterator, Sequence
from typing import TypeAlias

Rect: TypeAlias = tuple[float, float, float, float]
"""Left, top, right and bottom."""
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
    placed: dict[int, Rect] = {}
    for i in sorted(range(len(boxes)), key=lambda i: _area(boxes[i])):

        def hidden(place: Rect, i: int = i) -> tuple[float, bool, float]:
            labels = sum(_overlap(place, other) for other in placed.values())
            return labels, not is_beside(place, boxes[i]), sum(_overlap(place, box) for box in boxes)

        placed[i] = min((_within(place, bounds) for place in _candidates(boxes[i], sizes[i])), key=hidden)
    return [placed[i] for i in range(len(boxes))]


def is_beside(label: Rect, box: Rect) -> bool:
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


def _within(place: Rect, bounds: tuple[float, float]) -> Rect:
    left, top, right, bottom = place
    x = max(min(left, bounds[0] - (right - left)), 0.0)
    y = max(min(top, bounds[1] - (bottom - top)), 0.0)
    return x, y, x + right - left, y + bottom - top


def _area(rect: Rect) -> float:
    return (rect[2] - rect[0]) * (rect[3] - rect[1])


def _overlap(one: Rect, other: Rect) -> float:
    width = min(one[2], other[2]) - max(one[0], other[0])
    height = min(one[3], other[3]) - max(one[1], other[1])
    return max(width, 0.0) * max(height, 0.0)
