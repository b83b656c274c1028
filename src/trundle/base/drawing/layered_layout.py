"""Layered graph layout in columns from left to right, by Sugiyama's method.

K. Sugiyama, S. Tagawa, M. Toda: Methods for visual understanding of hierarchical system structures, 1981. An arrow that
spans columns has a slot in each of them, so that it never runs behind a box.
"""

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TypeAlias

Vertex: TypeAlias = Hashable
_SWEEPS = 12
"""Passes of sorting each column by its neighbors, which removes most crossings."""
_STRAIGHT = 8.0
"""Weight of a straight arrow relative to a centered box."""


@dataclass(frozen=True, slots=True)
class LayeredLayout:
    """Columns of boxes and slots, and their vertical positions."""

    columns: list[list[Vertex]]
    """Columns from left to right, each from top to bottom; a slot is (number of the edge, column)."""
    heights: dict[Vertex, float]
    """Vertical center of each vertex, from 0 at the topmost."""
    routes: list[list[Vertex]]
    """Vertices of each edge from start to end, slots included."""


def layered_layout(
    items: Sequence[Vertex], edges: Sequence[tuple[Vertex, Vertex]], *, box_gap: float, slot_gap: float
) -> LayeredLayout:
    """Place the boxes, each right of its inputs as far as loops allow.

    Args:
        items: boxes.
        edges: pairs of boxes, (from, to).
        box_gap: distance between the centers of two boxes in a column.
        slot_gap: distance between the centers of two slots.
    """
    order = _without_loops(items, edges)
    position = {item: i for i, item in enumerate(order)}
    forwards = [(a, b) if position[a] <= position[b] else (b, a) for a, b in edges]
    depth = _depths(order, forwards)
    columns: list[list[Vertex]] = [[] for _ in range(max(depth.values(), default=-1) + 1)]
    linked = {item for edge in edges for item in edge}
    for item in order:
        if item in linked:
            columns[depth[item]].append(item)
    links: dict[Vertex, tuple[list[Vertex], list[Vertex]]] = {item: ([], []) for item in order}
    routes: list[list[Vertex]] = []
    for i, ((start, _), (first, last)) in enumerate(zip(edges, forwards, strict=True)):
        slots: list[Vertex] = [(i, column) for column in range(depth[first] + 1, depth[last])]
        for column, slot in enumerate(slots, depth[first] + 1):
            columns[column].append(slot)
            links[slot] = ([], [])
        route = [first, *slots, last]
        for left, right in pairwise(route):
            links[left][1].append(right)
            links[right][0].append(left)
        routes.append(route if start == first else route[::-1])
    boxes = set(items)
    _sort(columns, links)
    heights = _heights(columns, links, boxes, box_gap, slot_gap)
    lowest = max(heights.values(), default=-box_gap)
    for item in (item for item in items if item not in linked):  # boxes without arrows go below all others
        lowest += box_gap
        heights[item] = lowest
        columns[0].append(item)
    top = min(heights.values(), default=0.0)
    return LayeredLayout(columns, {vertex: height - top for vertex, height in heights.items()}, routes)


def _without_loops(items: Sequence[Vertex], edges: Sequence[tuple[Vertex, Vertex]]) -> list[Vertex]:
    """Order the boxes so that all arrows point forwards, except those that close a loop."""
    successors: dict[Vertex, list[Vertex]] = {item: [] for item in items}
    has_input = {end for _, end in edges}
    for start, end in edges:
        successors[start].append(end)
    done: dict[Vertex, None] = {}
    entered: set[Vertex] = set()
    for first in sorted(items, key=lambda item: item in has_input):  # a loop is cut at its entry
        stack = [(first, iter(successors[first]))] if first not in entered else []
        entered.add(first)
        while stack:
            item, rest = stack[-1]
            successor = next((other for other in rest if other not in entered), None)
            if successor is None:
                done[item] = None
                stack.pop()
            else:
                entered.add(successor)
                stack.append((successor, iter(successors[successor])))
    return list(done)[::-1]


def _depths(order: Sequence[Vertex], forwards: Sequence[tuple[Vertex, Vertex]]) -> dict[Vertex, int]:
    """Return the column of each box: after its last input; without inputs, before its first output."""
    successors: dict[Vertex, list[Vertex]] = {item: [] for item in order}
    for start, end in forwards:
        if start != end:
            successors[start].append(end)
    depth = dict.fromkeys(order, 0)
    for item in order:
        for other in successors[item]:
            depth[other] = max(depth[other], depth[item] + 1)
    for item in order:
        if depth[item] == 0 and successors[item]:
            depth[item] = min(depth[other] for other in successors[item]) - 1
    return depth


def _sort(columns: list[list[Vertex]], links: Mapping[Vertex, tuple[list[Vertex], list[Vertex]]]) -> None:
    """Sort each column by the mean position of its neighbors, alternately left and right."""
    row = {vertex: float(i) for column in columns for i, vertex in enumerate(column)}
    for sweep in range(_SWEEPS):
        side = sweep % 2
        for column in columns if side == 0 else reversed(columns):
            preferred = {vertex: _mean([row[other] for other in links[vertex][side]], row[vertex]) for vertex in column}
            column.sort(key=lambda vertex: (preferred[vertex], row[vertex]))
            row.update((vertex, float(i)) for i, vertex in enumerate(column))


def _heights(
    columns: Sequence[Sequence[Vertex]],
    links: Mapping[Vertex, tuple[list[Vertex], list[Vertex]]],
    boxes: set[Vertex],
    box_gap: float,
    slot_gap: float,
) -> dict[Vertex, float]:
    """Return heights close to the neighbors', as far as the gaps allow."""
    gaps = {vertex: box_gap if vertex in boxes else slot_gap for column in columns for vertex in column}
    height = {vertex: 0.0 for column in columns for vertex in column}
    for sweep in range(_SWEEPS):
        for column in columns if sweep % 2 == 0 else reversed(columns):
            preferred = [
                _mean([height[other] for other in (*links[vertex][0], *links[vertex][1])], height[vertex])
                for vertex in column
            ]
            weights = [1.0 if vertex in boxes else _STRAIGHT for vertex in column]
            height.update(zip(column, _spread(preferred, weights, [gaps[vertex] for vertex in column]), strict=True))
    return height


def _spread(preferred: Sequence[float], weights: Sequence[float], gaps: Sequence[float]) -> list[float]:
    """Return the heights nearest to the preferred ones that keep order and gaps (pool adjacent violators)."""
    offsets = [0.0]
    for above, below in pairwise(gaps):
        offsets.append(offsets[-1] + (above + below) / 2)
    pools: list[tuple[float, float, int]] = []
    """Mean, weight, members."""
    for height, weight, offset in zip(preferred, weights, offsets, strict=False):
        mean, total, count = height - offset, weight, 1
        while pools and pools[-1][0] > mean:
            other, other_total, other_count = pools.pop()
            mean = (mean * total + other * other_total) / (total + other_total)
            total, count = total + other_total, count + other_count
        pools.append((mean, total, count))
    flat = [mean for mean, _, count in pools for _ in range(count)]
    return [mean + offset for mean, offset in zip(flat, offsets, strict=False)]


def _mean(values: Sequence[float], default: float) -> float:
    return sum(values) / len(values) if values else default
