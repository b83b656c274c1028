"""Charts of a sweep's report, as SVG with the page's colors."""

from collections.abc import Sequence
from html import escape

import numpy as np
from numpy.typing import NDArray

from .chart_axes import Axis, axis_of, tick_texts

_WIDTH, _HEIGHT = 320.0, 160.0
_LEFT, _RIGHT, _BOTTOM, _TOP = 44.0, 12.0, 20.0, 8.0
_TICKS_X, _TICKS_Y = 5, 3
_MAX_POINTS = 2000


def histogram(values: NDArray[np.float64], is_ok: NDArray[np.bool_]) -> str:
    """Draw the distribution of (rows,) values; runs that are not ok have another color."""
    finite = np.isfinite(values)
    values, is_ok = values[finite], is_ok[finite]
    if not len(values):
        return "<p>no run has a value</p>"
    low, high = float(values.min()), float(values.max())
    bins = int(min(max(np.sqrt(len(values)), 5), 40)) if high > low else 1
    edges = np.linspace(low, high, bins + 1) if high > low else np.array([low - 0.5, low + 0.5])
    total, ok = np.histogram(values, edges)[0], np.histogram(values[is_ok], edges)[0]
    across = Axis(float(edges[0]), float(edges[-1]), _LEFT, _WIDTH - _RIGHT)
    up = Axis(0.0, float(max(total.max(), 1)), _HEIGHT - _BOTTOM, _TOP)
    width, scale, base = (across.last - across.first) / bins, (up.first - up.last) / up.high, up.first
    bars: list[str] = []
    for i, (all_of, good) in enumerate(zip(total.tolist(), ok.tolist(), strict=True)):
        x = _LEFT + i * width
        tooltip = f"<title>{edges[i]:.4g} to {edges[i + 1]:.4g}: {all_of} runs, {all_of - good} not ok</title>"
        bars.append(_bar(x, base - good * scale, width, good * scale, "ok", tooltip))
        bars.append(_bar(x, base - all_of * scale, width, (all_of - good) * scale, "bad", tooltip))
    shown = across if high > low else Axis(low, low, across.first, across.last)
    counts = [tick for tick in up.ticks(_TICKS_Y) if tick == round(tick)]
    title = f"{len(values)} runs from {low:.4g} to {high:.4g}"
    return _svg([*_levels(up, counts), *bars, *_scale(shown, shown.ticks(_TICKS_X))], title)


def scatter(x: NDArray[np.float64], y: NDArray[np.float64], is_ok: NDArray[np.bool_], *, is_log: bool = False) -> str:
    """Draw (rows,) values against others; at most 2,000 evenly chosen points.

    Args:
        x: values on the horizontal axis.
        y: values on the vertical axis.
        is_ok: (rows,) True for runs that are ok.
        is_log: True for a logarithmic horizontal axis.
    """
    rows = np.flatnonzero(np.isfinite(x) & np.isfinite(y))
    rows = rows[:: max(-(-len(rows) // _MAX_POINTS), 1)]
    if not len(rows):
        return ""
    across = axis_of(x[rows], _LEFT + 3, _WIDTH - _RIGHT, is_log=is_log)
    up = axis_of(y[rows], _HEIGHT - _BOTTOM - 3, _TOP + 3)
    points = [
        f'<circle class="{"ok" if good else "bad"}" cx="{a:.1f}" cy="{b:.1f}" r="2"/>'
        for a, b, good in zip(across.coordinates(x[rows]), up.coordinates(y[rows]), is_ok[rows], strict=True)
    ]
    levels, scale = _levels(up, up.ticks(_TICKS_Y)), _scale(across, across.ticks(_TICKS_X))
    return _svg([*levels, *points, *scale], f"{len(rows)} points")


def correlation_bars(rows: Sequence[tuple[str, float | None]]) -> str:
    """Draw rank correlations, strongest first."""
    strongest = sorted(rows, key=lambda item: -abs(item[1] or 0.0))
    lines: list[str] = []
    for name, value in strongest:
        percent = 50 * abs(value or 0.0)
        left = 50 - percent if (value or 0.0) < 0 else 50
        number = "constant" if value is None else f"{value:+.2f}"
        bar = f'<span class="bar"><i style="left:{left:.1f}%;width:{percent:.1f}%"></i></span>'
        lines.append(f"<tr><th>{breakable(name)}</th><td>{bar}</td><td>{number}</td></tr>")
    return f'<table class="correlations">{"".join(lines)}</table>'


def breakable(name: str) -> str:
    """Return a name as HTML that breaks after the slashes of a path."""
    return escape(name).replace("/", "/<wbr>")


def _bar(x: float, y: float, width: float, height: float, kind: str, tooltip: str) -> str:
    if not height:
        return ""
    attributes = f'x="{x + 0.5:.1f}" y="{y:.1f}" width="{max(width - 1, 0.5):.1f}" height="{height:.1f}"'
    return f'<rect class="{kind}" {attributes}>{tooltip}</rect>'


def _scale(axis: Axis, ticks: list[float]) -> list[str]:
    """Draw the horizontal axis."""
    y = _HEIGHT - _BOTTOM
    coordinates = axis.coordinates(np.array(ticks))
    return [
        f'<line x1="{_LEFT}" y1="{y}" x2="{_WIDTH - _RIGHT}" y2="{y}"/>',
        *(f'<line x1="{x:.1f}" y1="{y}" x2="{x:.1f}" y2="{y + 3}"/>' for x in coordinates),
        *(
            f'<text x="{x:.1f}" y="{_HEIGHT - 5}" text-anchor="middle">{text}</text>'
            for x, text in zip(coordinates, tick_texts(ticks), strict=True)
        ),
    ]


def _levels(axis: Axis, ticks: list[float]) -> list[str]:
    """Draw horizontal lines at the ticks of the left axis."""
    coordinates = axis.coordinates(np.array(ticks))
    return [
        *(f'<line class="level" x1="{_LEFT}" y1="{y:.1f}" x2="{_WIDTH - _RIGHT}" y2="{y:.1f}"/>' for y in coordinates),
        *(
            f'<text x="{_LEFT - 6}" y="{y + 4:.1f}" text-anchor="end">{text}</text>'
            for y, text in zip(coordinates, tick_texts(ticks), strict=True)
        ),
    ]


def _svg(parts: list[str], title: str) -> str:
    size = f'viewBox="0 0 {_WIDTH:g} {_HEIGHT:g}"'
    return f'<svg {size} role="img" aria-label="{escape(title)}">{"".join(parts)}</svg>'
