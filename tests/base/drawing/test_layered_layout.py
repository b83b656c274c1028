"""Layout of graphs: no arrow runs behind a box or leaves the picture."""

import random
import re
from itertools import pairwise

import pytest

from trundle.base.drawing import Item, NodeGraph, graph_svg
from trundle.base.drawing.layered_layout import layered_layout
from trundle.base.xmlnode import XmlNode, parse_xml


def random_graph(seed: int, nodes: int, topics: int) -> NodeGraph:
    """Return a graph of random publishers and subscribers, with many loops and some isolated nodes."""
    rng = random.Random(seed)
    items: list[Item] = [("node", f"/{'n' * rng.randint(1, 20)}{i}") for i in range(nodes)]
    edges: list[tuple[Item, Item]] = []
    for i in range(topics):
        topic: Item = ("topic", f"/t{i}")
        items.append(topic)
        edges += [(node, topic) for node in rng.sample(items[:nodes], rng.randint(1, 2))]
        edges += [(topic, node) for node in rng.sample(items[:nodes], rng.randint(1, 3))]
    return NodeGraph(items, edges)


def points(path: XmlNode) -> list[tuple[float, float]]:
    """Sample points along a path of M, H and C, about 2 px apart."""
    result: list[tuple[float, float]] = []
    for letter, text in re.findall(r"([MHC])([-\d. ]+)", path.attribute("d") or ""):
        numbers = [float(number) for number in text.split()]
        if letter == "M":
            result.append((numbers[0], numbers[1]))
            continue
        x0, y0 = result[-1]
        steps = 100
        for step in range(1, steps + 1):
            t = step / steps
            if letter == "H":
                result.append((x0 + (numbers[0] - x0) * t, y0))
            else:
                xs, ys = (x0, *numbers[::2]), (y0, *numbers[1::2])
                weights = ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3)
                result.append((sum(map(float.__mul__, weights, xs)), sum(map(float.__mul__, weights, ys))))
    return result


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
        path_points = points(arrow)
        assert all(0 <= x <= width and 0 <= y <= height for x, y in path_points)
        assert not [
            (point, box)
            for point in path_points
            for box in boxes
            if box[0] + 0.1 < point[0] < box[0] + box[2] - 0.1 and box[1] < point[1] < box[1] + box[3]
        ]
    for (x, y, width0, height0), (x1, y1, wide1, high1) in pairwise(sorted(boxes)):
        assert x + width0 <= x1 or x1 + wide1 <= x or y + height0 <= y1 or y1 + high1 <= y


def test_a_node_without_inputs_is_one_column_left_of_its_first_subscriber() -> None:
    chain = [(f"{i}", f"{i + 1}") for i in range(4)]
    layout = layered_layout(["0", "1", "2", "3", "4", "late"], [*chain, ("late", "4")], box_gap=40, slot_gap=10)

    assert layout.columns[3] in (["3", "late"], ["late", "3"])
    assert layout.routes[-1] == ["late", "4"]


def test_a_loop_is_cut_at_its_entry() -> None:
    layout = layered_layout("abcin", [("a", "b"), ("b", "c"), ("c", "a"), ("i", "c")], box_gap=40, slot_gap=10)

    assert [column[0] for column in layout.columns] == ["i", "c", "a", "b"]
    assert layout.routes[1][0] == "b"
    assert len(layout.routes[1]) == 3
