"""Triangulation of polygons with holes by ear clipping."""

from collections.abc import Sequence
from typing import TypeAlias

Point: TypeAlias = tuple[float, float]
Triangle: TypeAlias = tuple[Point, Point, Point]


def triangulate(outlines: Sequence[Sequence[Point]]) -> list[Triangle]:
    """Triangulate the area inside an odd number of outlines; approximate for self-intersecting ones."""
    rings = [_cleaned(outline) for outline in outlines]
    rings = [ring for ring in rings if len(ring) >= 3 and _area(ring) != 0.0]
    depth = [sum(_is_inside(ring[0], other) for other in rings if other is not ring) for ring in rings]
    triangles: list[Triangle] = []
    for ring, level in zip(rings, depth, strict=True):
        if level % 2:
            continue
        holes = [
            hole
            for hole, below in zip(rings, depth, strict=True)
            if below == level + 1 and hole is not ring and _is_inside(hole[0], ring)
        ]
        triangles += _clip_ears(_bridged(ring, holes))
    return triangles


def _cleaned(outline: Sequence[Point]) -> list[Point]:
    """Return the outline without repeated corners."""
    ring = [point for point, before in zip(outline, [outline[-1], *outline[:-1]], strict=True) if point != before]
    return ring if ring else list(outline[:1])


def _area(ring: Sequence[Point]) -> float:
    """Return the signed area, positive counter-clockwise."""
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, [*ring[1:], ring[0]], strict=True)) / 2


def _is_inside(point: Point, ring: Sequence[Point]) -> bool:
    x, y = point
    inside = False
    for (x1, y1), (x2, y2) in zip(ring, [*ring[1:], ring[0]], strict=True):
        if (y1 > y) != (y2 > y) and x < x1 + (y - y1) / (y2 - y1) * (x2 - x1):
            inside = not inside
    return inside


def _bridged(ring: list[Point], holes: list[list[Point]]) -> list[Point]:
    """Connect each hole to the outer ring by a cut from its rightmost corner, and return one ring."""
    ring = ring if _area(ring) > 0 else ring[::-1]
    for hole in sorted(holes, key=lambda h: -max(x for x, _ in h)):
        hole = hole if _area(hole) < 0 else hole[::-1]
        start = max(range(len(hole)), key=lambda i: hole[i][0])
        turned = hole[start:] + hole[: start + 1]
        here = turned[0]
        visible = [i for i, corner in enumerate(ring) if not _is_cut(here, corner, [ring, hole])]
        to = min(visible or range(len(ring)), key=lambda i: (ring[i][0] - here[0]) ** 2 + (ring[i][1] - here[1]) ** 2)
        ring = [*ring[: to + 1], *turned, *ring[to:]]
    return ring


def _is_cut(a: Point, b: Point, rings: Sequence[Sequence[Point]]) -> bool:
    for ring in rings:
        for c, d in zip(ring, [*ring[1:], ring[0]], strict=True):
            if a in (c, d) or b in (c, d):
                continue
            if (
                _orientation(a, b, c) * _orientation(a, b, d) <= 0
                and _orientation(c, d, a) * _orientation(c, d, b) <= 0
            ):
                return True
    return False


def _orientation(a: Point, b: Point, c: Point) -> float:
    """Return a positive value if a, b, c are counter-clockwise."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _clip_ears(ring: list[Point]) -> list[Triangle]:
    left = list(ring)
    triangles: list[Triangle] = []
    while len(left) > 3:
        for i in range(len(left)):
            a, b, c = left[i - 1], left[i], left[(i + 1) % len(left)]
            if _orientation(a, b, c) > 0 and not any(_contains(a, b, c, p) for p in left if p not in (a, b, c)):
                triangles.append((a, b, c))
                del left[i]
                break
        else:
            # No ear: collinear corners or crossing lines.
            flat = min(
                range(len(left)), key=lambda i: abs(_orientation(left[i - 1], left[i], left[(i + 1) % len(left)]))
            )
            del left[flat]
    if _orientation(left[0], left[1], left[2]) > 0:
        triangles.append((left[0], left[1], left[2]))
    return triangles


def _contains(a: Point, b: Point, c: Point, p: Point) -> bool:
    return _orientation(a, b, p) >= 0 and _orientation(b, c, p) >= 0 and _orientation(c, a, p) >= 0
