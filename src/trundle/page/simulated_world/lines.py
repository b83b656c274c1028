"""Lines that plugins draw, for the page."""

from itertools import islice

import numpy as np

from trundle.page import Line
from trundle.sim.simulation import DebugLine, Simulation

MAX_LINE_POINTS = 20_000
"""Limit of points in all lines together."""
_MAX_LINES = 200


def plugin_lines(simulation: Simulation) -> list[Line]:
    """Return the lines that plugins draw; beyond the limit, only the first ones, each with its newest points."""
    lines: list[Line] = []
    remaining = MAX_LINE_POINTS
    for name, line in islice(simulation.lines.items(), _MAX_LINES):
        points = np.array(line.points[-remaining:], dtype=np.float32).reshape(-1, 3)
        lines.append(Line(id=name, rgba=_rgba(line), points=points))
        remaining -= len(points)
        if remaining <= 0:
            break
    return lines


def _rgba(line: DebugLine) -> tuple[int, int, int, int]:
    red, green, blue = (round(255 * min(max(value, 0.0), 1.0)) for value in line.rgb)
    return (red, green, blue, 255)
