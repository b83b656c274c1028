"""Two buildings of boxes: an office of corridors, and a flat full of furniture."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Box = tuple[float, float, float, float]
"""x from, to, y from, to [m]."""
_HEIGHT_M = 1.0
_THICK_M = 0.1


class Building(NamedTuple):
    """Walls and furniture, a way through the rooms, places to drive to."""

    boxes: tuple[Box, ...]
    """Whatever a robot may touch."""
    way: tuple[tuple[float, float], ...]
    """Corners of a way through all rooms; the robot starts at the first, toward the second [m]."""
    goals: tuple[tuple[float, float, float], ...]
    """x, y [m], yaw [rad]."""

    @property
    def inside(self) -> Box:
        """The outermost of the boxes' sides."""
        x0, x1, y0, y1 = np.array(self.boxes).T
        return float(x0.min()), float(x1.max()), float(y0.min()), float(y1.max())

    @property
    def sdf(self) -> str:
        """The boxes as a static model."""
        collisions = "".join(
            f'<collision name="box_{index}"><pose>{(x0 + x1) / 2} {(y0 + y1) / 2} {_HEIGHT_M / 2} 0 0 0</pose>'
            f"<geometry><box><size>{x1 - x0} {y1 - y0} {_HEIGHT_M}</size></box></geometry></collision>"
            for index, (x0, x1, y0, y1) in enumerate(self.boxes)
        )
        return f'<model name="building"><static>true</static><link name="walls">{collisions}</link></model>'

    def distances(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the distance of each point (n, 2) to the nearest box [m]; 0 inside one."""
        x, y = points[:, :1], points[:, 1:]
        x0, x1, y0, y1 = np.array(self.boxes).T
        beside = np.hypot(np.maximum(np.maximum(x0 - x, x - x1), 0.0), np.maximum(np.maximum(y0 - y, y - y1), 0.0))
        return beside.min(axis=1)


def _wall(x0: float, y0: float, x1: float, y1: float, doors: tuple[float, ...] = (), door_m: float = 0.9) -> list[Box]:
    """Return the pieces of a wall along x or y, with doors centered at those coordinates."""
    low, high = sorted((x0, x1) if y0 == y1 else (y0, y1))
    edges = [low, *(edge for door in doors for edge in (door - door_m / 2, door + door_m / 2)), high]
    half = _THICK_M / 2
    pieces = list(zip(edges[::2], edges[1::2], strict=True))
    if y0 == y1:
        return [(a, b, y0 - half, y0 + half) for a, b in pieces]
    return [(x0 - half, x0 + half, a, b) for a, b in pieces]


def _outer(x: float, y: float) -> list[Box]:
    return [*_wall(-x, -y, x, -y), *_wall(-x, y, x, y), *_wall(-x, -y, -x, y), *_wall(x, -y, x, y)]


def _office() -> Building:
    """20 m × 20 m: two corridors of 2 m that cross, and eight rooms with doors of 1.1 m and desks."""
    boxes = _outer(10.0, 10.0)
    for side in (-1.0, 1.0):
        for low, high in ((-10.0, -1.0), (1.0, 10.0)):
            boxes += _wall(low, side, high, side, (low + 2.25, low + 6.75), 1.1)
            boxes += _wall(side, low, side, high)
            middle = (low + high) / 2
            boxes += _wall(middle, side, middle, 10.0 * side)
            for x in (low + 2.25, low + 6.75):
                boxes.append((x - 0.8, x + 0.8, 6.0 * side - 0.4, 6.0 * side + 0.4))
            boxes.append((low + 0.4, low + 0.8, 8.0 * side - 1.0, 8.0 * side + 1.0))
    boxes += [(-0.95, -0.55, 7.0, 8.2), (0.5, 0.95, -6.0, -5.0)]
    rooms = [(x, side) for side in (1.0, -1.0) for x in (-7.75, -3.25, 3.25, 7.75)]
    way: list[tuple[float, float]] = [(-9.2, 0.0)]
    for x, side in rooms[:4]:
        way += [(x, 0.0), (x, side * 3.6), (x + 1.3, side * 4.6), (x, side * 3.6), (x, 0.0)]
    way += [(9.0, 0.0)]
    for x, side in rooms[:3:-1]:
        way += [(x, 0.0), (x, side * 3.6), (x + 1.3, side * 4.6), (x, side * 3.6), (x, 0.0)]
    way += [(0.0, 0.0), (0.0, 8.5), (0.0, -8.5), (0.0, 0.0), (-9.2, 0.0)]
    goals = ((-3.25, 4.0, math.pi / 2), (3.25, -4.0, -math.pi / 2), (0.0, 8.0, math.pi / 2), (7.75, 0.0, 0.0))
    return Building(tuple(boxes), tuple(way), goals)


def _flat() -> Building:
    """10 m × 8 m: five rooms with doors of 0.85 m, and furniture on legs."""
    boxes = _outer(5.0, 4.0)
    boxes += _wall(-1.5, -4.0, -1.5, 4.0, (-2.2, 1.0), 0.85)
    boxes += _wall(1.5, -4.0, 1.5, 4.0, (-1.2, 2.0), 0.85)
    boxes += _wall(-5.0, -0.5, -1.5, -0.5)
    boxes += _wall(1.5, 0.3, 5.0, 0.3)
    boxes += [(-4.9, -2.9, 1.9, 3.9), (-4.9, -4.3, -3.0, -1.2), (-2.2, -1.6, 2.6, 3.9), (-3.4, -2.4, -3.9, -3.4)]
    boxes += [(-0.6, 0.4, 3.2, 3.9), (1.0, 1.4, -3.9, -2.4), (-1.4, -0.9, -0.9, 0.2)]
    boxes += [(4.0, 4.9, 2.2, 3.9), (2.2, 3.2, 3.4, 3.9), (4.3, 4.9, -3.9, -2.0), (1.6, 2.6, -3.9, -3.3)]
    for x0, x1, y0, y1 in ((3.0, 4.2, 0.9, 1.7), (-3.9, -2.9, -2.3, -1.5), (2.6, 3.6, -1.9, -1.1)):
        boxes += [(x - 0.03, x + 0.03, y - 0.03, y + 0.03) for x in (x0, x1) for y in (y0, y1)]
    hall = ((0.3, -3.0), (0.3, 1.0))
    west = ((-2.3, 1.0), (-4.0, 0.9), (-2.3, 1.0), (0.2, 1.0), (0.2, 2.2))
    east = ((2.3, 2.1), (3.4, 2.7), (2.3, 2.1), (0.3, 1.8), (0.2, -1.2))
    south_east = ((2.2, -0.9), (2.8, -0.6), (3.6, -0.5), (4.1, -1.0), (3.95, -2.0), (3.4, -2.9), (2.2, -2.4))
    south_west = ((2.0, -1.2), (0.2, -1.2), (-0.2, -2.2), (-2.2, -2.2), (-2.4, -1.0), (-2.2, -2.2), (0.3, -2.2))
    way = (*hall, *west, *east, *south_east, *south_west)
    goals = ((-4.1, 0.6, math.pi), (2.4, 2.2, 0.0), (3.6, -2.8, 0.0), (-2.3, -1.1, math.pi / 2), (0.2, 2.4, 0.0))
    return Building(tuple(boxes), way, goals)


BUILDINGS = {"office": _office(), "flat": _flat()}
