"""Curves over time, as SVG or as text for a terminal."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

_COLORS = ("#2563a8", "#c2501b", "#2f8f4e", "#8a3fa0", "#b8860b", "#157f8c", "#b02a4c", "#5c6470")
_MARKS = "*+ox#%@&"
_WIDTH, _HEIGHT, _LEFT, _BOTTOM, _TOP, _LINE, _CHARACTER = 900, 420, 80, 40, 16, 18, 7.2
"""Width, height without the legend, margins, height of a line of the legend, width of a character [px]."""
_TICKS = 6
_NOISE = 1e-9
"""Ratio of a curve's span to its value below which the curve is drawn flat."""
_MAX_VALUE = 1e300
"""Largest value drawn; the span of larger values overflows a double."""


@dataclass(frozen=True, slots=True)
class Curve:
    """Name and (time [s], value) points in order of time."""

    name: str
    points: list[tuple[float, float]]


def curves_svg(curves: Sequence[Curve]) -> str:
    """Draw curves with axes and a legend below, as SVG."""
    times, values = _ranges(curves)
    right, low = _WIDTH - 20, _HEIGHT - _BOTTOM
    value_marks, time_marks = _ticks(*values), _ticks(*times)
    left = max(_LEFT, max(len(text) for _, text in value_marks) * _CHARACTER + 12)

    def x(t: float) -> float:
        return left + (t - times[0]) / (times[1] - times[0]) * (right - left)

    def y(value: float) -> float:
        return low - (value - values[0]) / (values[1] - values[0]) * (low - _TOP)

    lines = [f'<path class="grid" d="M{left:g} {y(v):.1f}H{right}"/>' for v, _ in value_marks]
    lines += [f'<path class="grid" d="M{x(t):.1f} {_TOP}V{low}"/>' for t, _ in time_marks]
    lines += [f'<text class="left" x="{left - 6:g}" y="{y(v) + 4:.1f}">{text}</text>' for v, text in value_marks]
    lines += [f'<text class="below" x="{x(t):.1f}" y="{low + 16}">{text} s</text>' for t, text in time_marks]
    for i, curve in enumerate(curves):
        color = _COLORS[i % len(_COLORS)]
        for piece in _pieces(curve):
            points = " ".join(f"{x(t):.1f},{y(value):.1f}" for t, value in _decimated(piece, times, right - _LEFT))
            lines.append(f'<polyline stroke="{color}" points="{points}"/>')
        line = _HEIGHT + i * _LINE
        lines.append(f'<rect x="{left:g}" y="{line}" width="14" height="4" fill="{color}"/>')
        lines.append(f'<text x="{left + 20:g}" y="{line + 6}">{escape(curve.name)}</text>')
    height = _HEIGHT + len(curves) * _LINE
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{_WIDTH}" height="{height}">',
            "<title>topics over time</title>",
            "<style>text{font:12px monospace;fill:#1d2733}.left{text-anchor:end}.below{text-anchor:middle}"
            ".grid{stroke:#dde2e8}polyline{fill:none;stroke-width:1.5}</style>",
            '<rect width="100%" height="100%" fill="#fff"/>',
            *lines,
            "</svg>",
            "",
        ]
    )


def curves_text(curves: Sequence[Curve], *, columns: int, rows: int) -> str:
    """Draw curves as text, with one character per curve."""
    times, values = _ranges(curves)
    digits = _digits(max(map(abs, values)), (values[1] - values[0]) / 10)
    bottom, top = (f"{value:.{digits}g}" for value in values)
    margin = max(10, len(bottom), len(top))
    rows, width = max(rows, 5), max(columns - margin - 2, 20)
    cells = [[" "] * width for _ in range(rows)]
    for i, curve in enumerate(curves):
        for t, value in curve.points:
            if abs(value) < _MAX_VALUE:
                column = round((t - times[0]) / (times[1] - times[0]) * (width - 1))
                row = round((value - values[0]) / (values[1] - values[0]) * (rows - 1))
                cells[rows - 1 - row][column] = _MARKS[i % len(_MARKS)]
    scale = [top, *[""] * (rows - 2), bottom]
    lines = [f"{text:>{margin}} │{''.join(row).rstrip()}" for text, row in zip(scale, cells, strict=True)]
    lines.append(f"{'':>{margin}} └{'─' * width}")
    lines.append(f"{'':>{margin + 2}}{f'{times[0]:.1f} s':<{width - 10}}{f'{times[1]:.1f} s':>10}")
    latest = [(curve.name, curve.points[-1][1]) for curve in curves if curve.points]
    lines += [
        f"{_MARKS[i % len(_MARKS)]:>{margin + 1}} {name} = {value:.{max(6, digits)}g}"
        for i, (name, value) in enumerate(latest)
    ]
    return "\n".join(lines)


def _ranges(curves: Sequence[Curve]) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the ranges of both axes; neither is empty."""
    times = [t for curve in curves if curve.points for t in (curve.points[0][0], curve.points[-1][0])] or [0.0]
    values = [value for curve in curves for _, value in curve.points if abs(value) < _MAX_VALUE] or [0.0]
    start, end, low, high = min(times), max(times), min(values), max(values)
    largest, span = max(abs(low), abs(high)), high - low
    margin = span * 0.05 if span > largest * _NOISE else largest * 0.05 or 1.0
    return (start, end if end > start else start + 1.0), (low - margin, high + margin)


def _ticks(low: float, high: float) -> list[tuple[float, str]]:
    """Return round tick values and their labels."""
    rough = (high - low) / _TICKS
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(factor * power for factor in (1, 2, 5, 10) if factor * power >= rough)
    first, last = math.ceil(low / step), math.floor(high / step)
    digits = max(6, _digits(max(abs(low), abs(high)), step))
    return [(i * step, f"{i * step:.{digits}g}") for i in range(first, last + 1)]


def _digits(largest: float, step: float) -> int:
    """Return the number of digits that distinguish values one step apart, as of large map eastings."""
    return max(4, math.ceil(math.log10(largest / step)) + 1)


def _pieces(curve: Curve) -> list[list[tuple[float, float]]]:
    """Split a curve at points that are not finite."""
    pieces: list[list[tuple[float, float]]] = [[]]
    for point in curve.points:
        if abs(point[1]) < _MAX_VALUE:
            pieces[-1].append(point)
        elif pieces[-1]:
            pieces.append([])
    return [piece for piece in pieces if piece]


def _decimated(
    points: Sequence[tuple[float, float]], times: tuple[float, float], width: int
) -> list[tuple[float, float]]:
    """Keep the first, smallest, largest and last point per pixel column."""
    by_column: dict[int, list[tuple[float, float]]] = {}
    for point in points:
        by_column.setdefault(int((point[0] - times[0]) / (times[1] - times[0]) * width), []).append(point)
    decimated: list[tuple[float, float]] = []
    for group in by_column.values():
        extremes = {group[0], group[-1], min(group, key=lambda p: p[1]), max(group, key=lambda p: p[1])}
        decimated += sorted(extremes)
    return decimated
