"""A graph of nodes and topics: as text for Graphviz, and as an SVG picture in columns from left to right."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape
from typing import Literal, TypeAlias

Item: TypeAlias = tuple[Literal["node", "topic"], str]
_ROW, _GAP, _HEIGHT, _CHARACTER, _MARGIN = 44, 70, 26, 7.2, 16
"""[px] Rows are this far apart, columns this far, boxes this high, letters this wide."""
_SWEEPS = 4
"""Passes of sorting each column by its neighbours, which takes most crossings out."""
_QUIET = ("/rosout", "/rosout_agg", "/clock", "/diagnostics", "/statistics")
"""What everybody talks about; rqt_graph hides them too."""


@dataclass(frozen=True, slots=True)
class Drawing:
    """Nodes, topics and the arrows between them."""

    items: list[Item]
    edges: list[tuple[Item, Item]]


def graph_of(
    publishers: Mapping[str, Sequence[str]], subscribers: Mapping[str, Sequence[str]], *, with_all: bool
) -> Drawing:
    """Who publishes what to whom.

    Args:
        publishers: topic → nodes.
        subscribers: topic → nodes.
        with_all: what everybody talks about, and what nobody hears, too.
    """
    topics = sorted({*publishers, *subscribers})
    if not with_all:
        topics = [t for t in topics if t not in _QUIET and t in publishers and t in subscribers]
    edges: list[tuple[Item, Item]] = []
    for topic in topics:
        item: Item = ("topic", topic)
        edges.extend((_node(name), item) for name in publishers.get(topic, []))
        edges.extend((item, _node(name)) for name in subscribers.get(topic, []))
    everybody = {node for table in (publishers, subscribers) for nodes in table.values() for node in nodes}
    items: list[Item] = [_node(name) for name in sorted(everybody) if name != "/rosout" or with_all]
    return Drawing([*items, *(("topic", topic) for topic in topics)], edges)


def _node(name: str) -> Item:
    return "node", name


def graph_dot(drawing: Drawing) -> str:
    """Write it in Graphviz' language: nodes round, topics square."""
    lines = ["digraph graphname {", "  rankdir=LR;"]
    for kind, name in drawing.items:
        lines.append(f"  {_id(kind, name)} [label={_text(name)}, shape={'ellipse' if kind == 'node' else 'box'}];")
    lines += [f"  {_id(*start)} -> {_id(*end)};" for start, end in drawing.edges]
    return "\n".join([*lines, "}", ""])


def graph_svg(drawing: Drawing) -> str:
    """Draw it: each item right of those that feed it, as far as loops allow."""
    columns = _columns(drawing)
    places: dict[Item, tuple[float, float, float]] = {}
    """x, y, width of each box."""
    left = float(_MARGIN)
    tallest = max(map(len, columns), default=0)
    for column in columns:
        width = max(len(name) for _, name in column) * _CHARACTER + 20
        top = _MARGIN + (tallest - len(column)) * _ROW / 2
        for row, item in enumerate(column):
            own = len(item[1]) * _CHARACTER + 20
            places[item] = (left + (width - own) / 2, top + row * _ROW, own)
        left += width + _GAP
    size = f'width="{max(left - _GAP, 0) + _MARGIN:g}" height="{tallest * _ROW + _MARGIN:g}"'
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" {size}>',
            "<title>ROS graph</title>",
            "<style>text{font:12px monospace;fill:#1d2733;text-anchor:middle}.node{fill:#dfeefc;stroke:#5b8db8}"
            ".topic{fill:#f3f4f6;stroke:#8a93a0}path{fill:none;stroke:#7a90a8}marker path{fill:#7a90a8}</style>",
            '<marker id="tip" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="8" markerHeight="8" orient="auto">'
            '<path d="M0 0L8 4L0 8z"/></marker>',
            '<rect width="100%" height="100%" fill="#fff"/>',
            *(_arrow(places[start], places[end]) for start, end in drawing.edges if start in places and end in places),
            *(_box(item, place) for item, place in places.items()),
            "</svg>",
            "",
        ]
    )


def _columns(drawing: Drawing) -> list[list[Item]]:
    """Put each item into the column after the last of those that feed it; an edge that closes a loop counts not."""
    below: dict[Item, list[Item]] = {item: [] for item in drawing.items}
    for start, end in drawing.edges:
        below.setdefault(start, []).append(end)
        below.setdefault(end, [])
    order = _without_loops(below)
    depth = dict.fromkeys(order, 0)
    position = {item: i for i, item in enumerate(order)}
    for item in order:
        for other in below[item]:
            if position[other] > position[item]:
                depth[other] = max(depth[other], depth[item] + 1)
    columns: list[list[Item]] = [[] for _ in range(max(depth.values(), default=-1) + 1)]
    for item in order:
        columns[depth[item]].append(item)
    above: dict[Item, list[Item]] = {item: [] for item in below}
    for item, others in below.items():
        for other in others:
            above[other].append(item)
    for _ in range(_SWEEPS):
        rows = {item: row / len(column) for column in columns for row, item in enumerate(column)}
        for column in columns:
            column.sort(key=lambda item: _mean([rows[other] for other in (*above[item], *below[item])]))
    return columns


def _without_loops(below: dict[Item, list[Item]]) -> list[Item]:
    """Order the items so that arrows point forwards, but for those that close a loop."""
    done: dict[Item, None] = {}
    entered: set[Item] = set()
    for first in below:
        waiting = [(first, iter(below[first]))] if first not in entered else []
        entered.add(first)
        while waiting:
            item, rest = waiting[-1]
            following = next((other for other in rest if other not in entered), None)
            if following is None:
                done[item] = None
                waiting.pop()
            else:
                entered.add(following)
                waiting.append((following, iter(below[following])))
    return list(done)[::-1]


def _mean(values: list[float]) -> float:
    return sum(values) / len(values) if values else 0.5


def _arrow(start: tuple[float, float, float], end: tuple[float, float, float]) -> str:
    x0, y0 = start[0] + start[2], start[1] + _HEIGHT / 2
    x1, y1 = end[0], end[1] + _HEIGHT / 2
    bend = max(30.0, abs(x1 - x0) / 2)
    return f'<path d="M{x0:g} {y0:g}C{x0 + bend:g} {y0:g} {x1 - bend:g} {y1:g} {x1:g} {y1:g}" marker-end="url(#tip)"/>'


def _box(item: Item, place: tuple[float, float, float]) -> str:
    kind, name = item
    x, y, width = place
    radius = _HEIGHT / 2 if kind == "node" else 3
    return (
        f'<rect class="{kind}" x="{x:g}" y="{y:g}" width="{width:g}" height="{_HEIGHT}" rx="{radius:g}"/>'
        f'<text x="{x + width / 2:g}" y="{y + 17:g}">{escape(name)}</text>'
    )


def _id(kind: str, name: str) -> str:
    return _text(f"{kind[0]}_{name}")


def _text(name: str) -> str:
    return '"' + name.replace("\\", "\\\\").replace('"', '\\"') + '"'
