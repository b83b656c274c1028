"""Lines of the page: those that plugins draw, and the rays of lidars and cones of sonars with <visualize>."""

from itertools import islice

import numpy as np

from trundle.page import Line
from trundle.sim.simulation import DebugLine, Simulation

MAX_LINE_POINTS = 20_000
"""Most points of all lines that plugins draw."""
_MAX_LINES = 200


def plugin_lines(simulation: Simulation) -> list[Line]:
    """Return the lines that plugins draw; of too many points, the newest of the first lines."""
    lines: list[Line] = []
    left = MAX_LINE_POINTS
    for name, line in islice(simulation.lines.items(), _MAX_LINES):
        points = np.array(line.points[-left:], dtype=np.float32).reshape(-1, 3)
        lines.append(Line(id=name, rgba=_rgba(line), points=points))
        left -= len(points)
        if left <= 0:
            break
    return lines


def _rgba(line: DebugLine) -> tuple[int, int, int, int]:
    red, green, blue = (round(255 * min(max(value, 0.0), 1.0)) for value in line.rgb)
    return (red, green, blue, 255)
