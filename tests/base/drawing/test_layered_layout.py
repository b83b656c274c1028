"""Pictures of graphs can be read: no arrow runs behind a box, none leaves the picture."""

import random
import re
from itertools import pairwise

import pytest

from trundle.base import drawing as room
from trundle.base.drawing import Item, NodeGraph, graph_svg
from trundle.base.drawing.layered_layout import layered_layout
from trundle.base.xmlnode import XmlNode, parse_xml


def test_the_front_door_exports_in_order() -> None:
    assert room.__all__ == sorted(room.__all__)
    assert all(hasattr(room, name) for name in room.__all__)


def random_graph(seed: int, nodes: int, topics: int) -> NodeGraph:
    """Random publishers and subscribers, with many loops and some isolated nodes."""
    lots = random.Random(seed)
    items: list[Item] = [("node", f"/{'n' * lots.randint(1, 20)}{i}") for i in range(nodes)]
    edges: list[tuple[Item, Item]] = []
    for i in range(topics):
        topic: Item = ("topic", f"/t{i}")
        items.append(topic)
        edges += [(node, topic) for node in lots.sample(items[:nodes], lots.randint(1, 2))]
        edges += [(topic, node) for node in lots.sample(items[:nodes], lots.randint(1, 3))]
    return NodeGraph(items, edges)


def points(path: XmlNode) -> list[tuple[float, float]]:
    """Points along a path of M, H and C, some 2 px apart."""
    found: list[tuple[float, float]] = []
    for letter, text in re.findall(r"([MHC])([-\d. ]+)", path.attribute("d") or ""):
        numbers = [float(number) for number in text.split()]
        if letter == "M":
            found.append((numbers[0], numbers[1]))
            continue
        x0, y0 = found[-1]
        steps = 100
        for step in range(1, steps + 1):
            t = step / steps
            if letter == "H":
                found.append((x0 + (numbers[0] - x0) * t, y0))
            else:
                xs, ys = (x0, *numbers[::2]), (y0, *numbers[1::2])
                weights = ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3)
                found.append((sum(map(float.__mul__, weights, xs)), sum(map(float.__mul__, weights, ys))))
    return found


@pytest.mark.parametrize("seed", range(5))
def test_no_arrow_runs_behind_a_box_or_out_of_the_picture(seed: int) -> None:
    drawing = random_graph(seed, nodes=20, topics=25)
    picture = parse_xml(graph_svg(drawing), name="x.svg")

    width, height = (float(picture.attribute(name) or 0) for name in ("width", "height"))
    boxes = [
        tuple(float(rect.attribute(name) or 0) for name in ("x", "y", "width", "height"))
        for rect in picture.all("rect")
        if rect.attribute("class")
    ]
    arrows = [path for path in picture.all("path") if path.attribute("marker-end")]
    assert (len(boxes), len(arrows)) == (45, len(drawing.edges))
    for arrow in arrows:
        along = points(arrow)
        assert all(0 <= x <= width and 0 <= y <= height for x, y in along)
        assert not [
            (point, box)
            for point in along
            for box in boxes
            if box[0] + 0.1 < point[0] < box[0] + box[2] - 0.1 and box[1] < point[1] < box[1] + box[3]
        ]
    for (x, y, wide, high), (x1, y1, wide1, high1) in pairwise(sorted(boxes)):
        assert x + wide <= x1 or x1 + wide1 <= x or y + high <= y1 or y1 + high1 <= y


def test_who_only_talks_stands_beside_those_who_hear_him() -> None:
    chain = [(f"{i}", f"{i + 1}") for i in range(4)]
    placed = layered_layout(["0", "1", "2", "3", "4", "late"], [*chain, ("late", "4")], box_gap=40, slot_gap=10)

    assert placed.columns[3] in (["3", "late"], ["late", "3"])
    assert placed.routes[-1] == ["late", "4"]


def test_a_loop_is_cut_where_something_comes_into_it() -> None:
    placed = layered_layout("abcin", [("a", "b"), ("b", "c"), ("c", "a"), ("i", "c")], box_gap=40, slot_gap=10)

    assert [column[0] for column in placed.columns] == ["i", "c", "a", "b"]
    assert placed.routes[1][0] == "b"
    assert len(placed.routes[1]) == 3
