"""Curves over time: as an SVG picture, and as characters for a terminal."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

_COLOURS = ("#2563a8", "#c2501b", "#2f8f4e", "#8a3fa0", "#b8860b", "#157f8c", "#b02a4c", "#5c6470")
_MARKS = "*+ox#%@&"
_WIDTH, _HEIGHT, _LEFT, _BOTTOM, _TOP, _LINE = 900, 420, 80, 40, 16, 18
"""[px] Of the picture without its legend, of its margins, and of a line of the legend."""
_TICKS = 6


@dataclass(frozen=True, slots=True)
class Curve:
    """A name and (time [s], value) in order of time."""

    name: str
    points: list[tuple[float, float]]


def curves_svg(curves: Sequence[Curve]) -> str:
    """Draw curves with axes and a legend below."""
    times, values = _ranges(curves)
    right, low = _WIDTH - 20, _HEIGHT - _BOTTOM

    def x(t: float) -> float:
        return _LEFT + (t - times[0]) / (times[1] - times[0]) * (right - _LEFT)

    def y(value: float) -> float:
        return low - (value - values[0]) / (values[1] - values[0]) * (low - _TOP)

    lines = [f'<path class="grid" d="M{_LEFT} {y(v):.1f}H{right}"/>' for v in _ticks(*values)]
    lines += [f'<path class="grid" d="M{x(t):.1f} {_TOP}V{low}"/>' for t in _ticks(*times)]
    lines += [f'<text class="left" x="{_LEFT - 6}" y="{y(v) + 4:.1f}">{v:g}</text>' for v in _ticks(*values)]
    lines += [f'<text class="below" x="{x(t):.1f}" y="{low + 16}">{t:g} s</text>' for t in _ticks(*times)]
    for i, curve in enumerate(curves):
        colour = _COLOURS[i % len(_COLOURS)]
        for piece in _pieces(curve):
            points = " ".join(f"{x(t):.1f},{y(value):.1f}" for t, value in _thinned(piece, times, right - _LEFT))
            lines.append(f'<polyline stroke="{colour}" points="{points}"/>')
        line = _HEIGHT + i * _LINE
        lines.append(f'<rect x="{_LEFT}" y="{line}" width="14" height="4" fill="{colour}"/>')
        lines.append(f'<text x="{_LEFT + 20}" y="{line + 6}">{escape(curve.name)}</text>')
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
    """Draw curves with characters, one kind for each curve."""
    times, values = _ranges(curves)
    rows, wide = max(rows, 5), max(columns - 12, 20)
    cells = [[" "] * wide for _ in range(rows)]
    for i, curve in enumerate(curves):
        for t, value in curve.points:
            if math.isfinite(value):
                column = round((t - times[0]) / (times[1] - times[0]) * (wide - 1))
                row = round((value - values[0]) / (values[1] - values[0]) * (rows - 1))
                cells[rows - 1 - row][column] = _MARKS[i % len(_MARKS)]
    scale = [""] * rows
    scale[0], scale[-1] = f"{values[1]:.4g}", f"{values[0]:.4g}"
    lines = [f"{text:>10} │{''.join(row).rstrip()}" for text, row in zip(scale, cells, strict=True)]
    lines.append(f"{'':>10} └{'─' * wide}")
    lines.append(f"{'':>12}{f'{times[0]:.1f} s':<{wide - 10}}{f'{times[1]:.1f} s':>10}")
    latest = [(curve.name, curve.points[-1][1]) for curve in curves if curve.points]
    lines += [f"{_MARKS[i % len(_MARKS)]:>11} {name} = {value:g}" for i, (name, value) in enumerate(latest)]
    return "\n".join(lines)


def _ranges(curves: Sequence[Curve]) -> tuple[tuple[float, float], tuple[float, float]]:
    """What the axes span; never nothing."""
    times = [t for curve in curves if curve.points for t in (curve.points[0][0], curve.points[-1][0])] or [0.0]
    values = [value for curve in curves for _, value in curve.points if math.isfinite(value)] or [0.0]
    start, end, low, high = min(times), max(times), min(values), max(values)
    margin = (high - low) * 0.05 or abs(high) * 0.05 or 1.0
    return (start, end if end > start else start + 1.0), (low - margin, high + margin)


def _ticks(low: float, high: float) -> list[float]:
    """Round numbers between two."""
    rough = (high - low) / _TICKS
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(factor * power for factor in (1, 2, 5, 10) if factor * power >= rough)
    first, last = math.ceil(low / step), math.floor(high / step)
    return [i * step for i in range(first, last + 1)]


def _pieces(curve: Curve) -> list[list[tuple[float, float]]]:
    """A curve is broken where it is no number."""
    pieces: list[list[tuple[float, float]]] = [[]]
    for point in curve.points:
        if math.isfinite(point[1]):
            pieces[-1].append(point)
        elif pieces[-1]:
            pieces.append([])
    return [piece for piece in pieces if piece]


def _thinned(
    points: Sequence[tuple[float, float]], times: tuple[float, float], width: int
) -> list[tuple[float, float]]:
    """Leave of the points above one pixel the first, the least, the greatest and the last."""
    above: dict[int, list[tuple[float, float]]] = {}
    for point in points:
        above.setdefault(int((point[0] - times[0]) / (times[1] - times[0]) * width), []).append(point)
    kept: list[tuple[float, float]] = []
    for group in above.values():
        extremes = {group[0], group[-1], min(group, key=lambda p: p[1]), max(group, key=lambda p: p[1])}
        kept += sorted(extremes)
    return kept
