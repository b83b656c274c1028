"""Labels of boxes that lie close together."""

from random import Random

from trundle.studies.datasets.label_layout import layout_labels, touches_box

BOUNDS = (400.0, 300.0)


def _covers(one: tuple[float, ...], other: tuple[float, ...]) -> bool:
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]


def test_a_box_alone_has_its_label_above_it() -> None:
    assert layout_labels([(50, 60, 90, 100)], [(40, 12)], BOUNDS) == [(50, 48, 90, 60)]


def test_labels_of_a_crowd_cover_no_other_and_stay_in_the_picture() -> None:
    random = Random(0)
    corners = [(random.uniform(100, 200), random.uniform(80, 180)) for _ in range(20)]
    boxes = [(x, y, x + 30, y + 30) for x, y in corners]

    labels = layout_labels(boxes, [(60.0, 14.0)] * 20, BOUNDS)

    assert not [(i, j) for i in range(20) for j in range(i) if _covers(labels[i], labels[j])]
    assert all(min(left, top) >= 0 and right <= 400 and bottom <= 300 for left, top, right, bottom in labels)
    assert sum(touches_box(label, box) for label, box in zip(labels, boxes, strict=True)) >= 10


def test_boxes_at_the_edge_and_the_same_box_twice() -> None:
    boxes = [(0.0, 0.0, 20.0, 20.0), (0.0, 0.0, 20.0, 20.0), (390.0, 0.0, 400.0, 10.0)]

    first, second, third = layout_labels(boxes, [(50.0, 12.0)] * 3, BOUNDS)

    assert not _covers(first, second)
    assert touches_box(first, boxes[0])
    assert touches_box(second, boxes[1])
    assert (third[0], third[2]) == (350, 400)
