"""Graph of nodes and topics, as DOT or as SVG with columns from left to right."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape
from itertools import pairwise
from typing import Literal, TypeAlias

from .layered_layout import Vertex, layered_layout

Item: TypeAlias = tuple[Literal["node", "topic"], str]
_ROW, _SLOT, _GAP, _HEIGHT, _CHARACTER, _MARGIN = 40, 12, 80, 26, 7.2, 16
"""Height of a row with a box, of a row with a passing arrow; column gap, box height, character width, margin [px]."""
_LEVEL, _LOWER = 10, 7
"""Length of an arrow's horizontal ends, and vertical offset of the ends of a loop-closing arrow [px]."""
_QUIET = ("/rosout", "/rosout_agg", "/clock", "/diagnostics", "/statistics")
"""Topics of almost every node, which rqt_graph hides too."""


@dataclass(frozen=True, slots=True)
class NodeGraph:
    """Nodes, topics and arrows."""

    items: list[Item]
    edges: list[tuple[Item, Item]]


def node_graph(
    publishers: Mapping[str, Sequence[str]], subscribers: Mapping[str, Sequence[str]], *, with_all: bool
) -> NodeGraph:
    """Build the graph of publishers and subscribers.

    Args:
        publishers: topic → nodes.
        subscribers: topic → nodes.
        with_all: include topics such as /rosout, and topics without subscribers or publishers.
    """
    topics = sorted({*publishers, *subscribers})
    if not with_all:
        topics = [t for t in topics if t not in _QUIET and t in publishers and t in subscribers]
    edges: list[tuple[Item, Item]] = []
    for topic in topics:
        item: Item = ("topic", topic)
        edges.extend((_node(name), item) for name in publishers.get(topic, []))
        edges.extend((item, _node(name)) for name in subscribers.get(topic, []))
    names = {name for table in (publishers, subscribers) for nodes in table.values() for name in nodes}
    items: list[Item] = [_node(name) for name in sorted(names) if name != "/rosout" or with_all]
    return NodeGraph([*items, *(("topic", topic) for topic in topics)], edges)


def _node(name: str) -> Item:
    return "node", name


def graph_dot(drawing: NodeGraph) -> str:
    """Write the graph in DOT: nodes round, topics square."""
    lines = ["digraph graphname {", "  rankdir=LR;"]
    for kind, name in drawing.items:
        lines.append(f"  {_id(kind, name)} [label={_text(name)}, shape={'ellipse' if kind == 'node' else 'box'}];")
    lines += [f"  {_id(*start)} -> {_id(*end)};" for start, end in drawing.edges]
    return "\n".join([*lines, "}", ""])


def graph_svg(drawing: NodeGraph) -> str:
    """Draw the graph as SVG, each item right of its inputs as far as loops allow."""
    placed = layered_layout(drawing.items, drawing.edges, box_gap=_ROW, slot_gap=_SLOT)
    widths: dict[Vertex, float] = {item: len(item[1]) * _CHARACTER + 20 for item in drawing.items}
    slots: dict[Vertex, _Slot] = {}
    left = float(_MARGIN)
    for column in placed.columns:
        widest = max((widths.get(vertex, 0.0) for vertex in column), default=0.0)
        for vertex in column:
            width = widths.get(vertex, widest)
            middle = _MARGIN + _HEIGHT / 2 + placed.heights[vertex]
            slots[vertex] = _Slot(left + (widest - width) / 2, middle, width, (left - _LEVEL, left + widest + _LEVEL))
        left += widest + _GAP
    height = max(placed.heights.values(), default=0.0) + _HEIGHT + 2 * _MARGIN
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{max(left - _GAP, 0) + _MARGIN:g}" height="{height:g}">',
            "<title>ROS graph</title>",
            "<style>text{font:12px monospace;fill:#1d2733;text-anchor:middle}.node{fill:#dfeefc;stroke:#5b8db8}"
            ".topic{fill:#f3f4f6;stroke:#8a93a0}path{fill:none;stroke:#7a90a8}marker path{fill:#7a90a8}</style>",
            '<marker id="tip" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="8" markerHeight="8" orient="auto">'
            '<path d="M0 0L8 4L0 8z"/></marker>',
            '<rect width="100%" height="100%" fill="#fff"/>',
            *(_arrow([slots[vertex] for vertex in route]) for route in placed.routes),
            *(_box(item, slots[item]) for item in drawing.items),
            "</svg>",
            "",
        ]
    )


@dataclass(frozen=True, slots=True)
class _Slot:
    """Position of a box, or of an arrow passing a column [px]."""

    left: float
    middle: float
    width: float
    column: tuple[float, float]
    """Left and right end of the horizontal part of arrows."""


def _arrow(route: Sequence[_Slot]) -> str:
    """Draw an arrow, horizontal through columns and curved between them; a loop-closing one runs from right to left."""
    forwards = route[0].column <= route[-1].column
    start, end = route[0], route[-1]
    heights = [slot.middle for slot in route]
    if not forwards:
        heights[0] += _LOWER
        heights[-1] += _LOWER
    path = f"M{start.left + start.width if forwards else start.left:.1f} {heights[0]:.1f}"
    for (one, y0), (other, y1) in pairwise(zip(route, heights, strict=True)):
        x0, x1 = (one.column[1], other.column[0]) if forwards else (one.column[0], other.column[1])
        half = (x0 + x1) / 2
        path += f"H{x0:.1f}C{half:.1f} {y0:.1f} {half:.1f} {y1:.1f} {x1:.1f} {y1:.1f}"
    return f'<path d="{path}H{end.left if forwards else end.left + end.width:.1f}" marker-end="url(#tip)"/>'


def _box(item: Item, slot: _Slot) -> str:
    kind, name = item
    radius = _HEIGHT / 2 if kind == "node" else 3
    return (
        f'<rect class="{kind}" x="{slot.left:.1f}" y="{slot.middle - _HEIGHT / 2:.1f}" width="{slot.width:.1f}" '
        f'height="{_HEIGHT}" rx="{radius:g}"/>'
        f'<text x="{slot.left + slot.width / 2:.1f}" y="{slot.middle + 4:.1f}">{escape(name)}</text>'
    )


def _id(kind: str, name: str) -> str:
    return _text(f"{kind[0]}_{name}")


def _text(name: str) -> str:
    return '"' + name.replace("\\", "\\\\").replace('"', '\\"') + '"'
