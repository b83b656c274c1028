"""Charts of a sweep's report, as SVG that takes its colours from the page."""

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
    """Draw the distribution of (rows,) values; the part of the runs that are not ok stands out."""
    found = np.isfinite(values)
    values, is_ok = values[found], is_ok[found]
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
        said = f"<title>{edges[i]:.4g} to {edges[i + 1]:.4g}: {all_of} runs, {all_of - good} not ok</title>"
        bars.append(_bar(x, base - good * scale, width, good * scale, "ok", said))
        bars.append(_bar(x, base - all_of * scale, width, (all_of - good) * scale, "bad", said))
    shown = across if high > low else Axis(low, low, across.first, across.last)
    counts = [tick for tick in up.ticks(_TICKS_Y) if tick == round(tick)]
    title = f"{len(values)} runs from {low:.4g} to {high:.4g}"
    return _svg([*_levels(up, counts), *bars, *_scale(shown, shown.ticks(_TICKS_X))], title)


def scatter(x: NDArray[np.float64], y: NDArray[np.float64], is_ok: NDArray[np.bool_], *, is_log: bool = False) -> str:
    """Draw (rows,) values against others; at most 2,000 evenly chosen points.

    Args:
        x: values along the width.
        y: values along the height.
        is_ok: of each row.
        is_log: draw `x` by its logarithm.
    """
    found = np.flatnonzero(np.isfinite(x) & np.isfinite(y))
    found = found[:: max(-(-len(found) // _MAX_POINTS), 1)]
    if not len(found):
        return ""
    across = axis_of(x[found], _LEFT + 3, _WIDTH - _RIGHT, is_log=is_log)
    up = axis_of(y[found], _HEIGHT - _BOTTOM - 3, _TOP + 3)
    points = [
        f'<circle class="{"ok" if good else "bad"}" cx="{a:.1f}" cy="{b:.1f}" r="2"/>'
        for a, b, good in zip(across.place(x[found]), up.place(y[found]), is_ok[found], strict=True)
    ]
    levels, scale = _levels(up, up.ticks(_TICKS_Y)), _scale(across, across.ticks(_TICKS_X))
    return _svg([*levels, *points, *scale], f"{len(found)} points")


def correlation_bars(rows: Sequence[tuple[str, float | None]]) -> str:
    """Draw rank correlations, the strongest first."""
    strongest = sorted(rows, key=lambda each: -abs(each[1] or 0.0))
    lines: list[str] = []
    for name, value in strongest:
        share = 50 * abs(value or 0.0)
        left = 50 - share if (value or 0.0) < 0 else 50
        number = "constant" if value is None else f"{value:+.2f}"
        bar = f'<span class="bar"><i style="left:{left:.1f}%;width:{share:.1f}%"></i></span>'
        lines.append(f"<tr><th>{breakable(name)}</th><td>{bar}</td><td>{number}</td></tr>")
    return f'<table class="correlations">{"".join(lines)}</table>'


def breakable(name: str) -> str:
    """Return a name as HTML that breaks after the slashes of a path."""
    return escape(name).replace("/", "/<wbr>")


def _bar(x: float, y: float, width: float, height: float, kind: str, said: str) -> str:
    if not height:
        return ""
    box = f'x="{x + 0.5:.1f}" y="{y:.1f}" width="{max(width - 1, 0.5):.1f}" height="{height:.1f}"'
    return f'<rect class="{kind}" {box}>{said}</rect>'


def _scale(axis: Axis, ticks: list[float]) -> list[str]:
    """Draw the axis below."""
    y = _HEIGHT - _BOTTOM
    places = axis.place(np.array(ticks))
    return [
        f'<line x1="{_LEFT}" y1="{y}" x2="{_WIDTH - _RIGHT}" y2="{y}"/>',
        *(f'<line x1="{x:.1f}" y1="{y}" x2="{x:.1f}" y2="{y + 3}"/>' for x in places),
        *(
            f'<text x="{x:.1f}" y="{_HEIGHT - 5}" text-anchor="middle">{text}</text>'
            for x, text in zip(places, tick_texts(ticks), strict=True)
        ),
    ]


def _levels(axis: Axis, ticks: list[float]) -> list[str]:
    """Draw lines across at the ticks of the axis on the left."""
    places = axis.place(np.array(ticks))
    return [
        *(f'<line class="level" x1="{_LEFT}" y1="{y:.1f}" x2="{_WIDTH - _RIGHT}" y2="{y:.1f}"/>' for y in places),
        *(
            f'<text x="{_LEFT - 6}" y="{y + 4:.1f}" text-anchor="end">{text}</text>'
            for y, text in zip(places, tick_texts(ticks), strict=True)
        ),
    ]


def _svg(parts: list[str], title: str) -> str:
    size = f'viewBox="0 0 {_WIDTH:g} {_HEIGHT:g}"'
    return f'<svg {size} role="img" aria-label="{escape(title)}">{"".join(parts)}</svg>'
