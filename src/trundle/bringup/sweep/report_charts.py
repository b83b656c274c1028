"""Charts of a sweep's report, as SVG that takes its colours from the page."""

from collections.abc import Sequence
from html import escape

import numpy as np
from numpy.typing import NDArray

_WIDTH, _HEIGHT = 320.0, 160.0
_LEFT, _BOTTOM, _TOP = 8.0, 18.0, 6.0
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
    width, most = (_WIDTH - 2 * _LEFT) / bins, max(int(total.max()), 1)
    scale = (_HEIGHT - _BOTTOM - _TOP) / most
    bars: list[str] = []
    for i, (all_of, good) in enumerate(zip(total.tolist(), ok.tolist(), strict=True)):
        x, base = _LEFT + i * width, _HEIGHT - _BOTTOM
        said = f"<title>{edges[i]:.4g} to {edges[i + 1]:.4g}: {all_of} runs, {all_of - good} not ok</title>"
        bars.append(_bar(x, base - good * scale, width, good * scale, "ok", said))
        bars.append(_bar(x, base - all_of * scale, width, (all_of - good) * scale, "bad", said))
    return _svg([*bars, *_axis(low, high)], f"{len(values)} runs from {low:.4g} to {high:.4g}")


def scatter(x: NDArray[np.float64], y: NDArray[np.float64], is_ok: NDArray[np.bool_]) -> str:
    """Draw (rows,) values against others; at most 2,000 evenly chosen points."""
    found = np.flatnonzero(np.isfinite(x) & np.isfinite(y))
    found = found[:: max(-(-len(found) // _MAX_POINTS), 1)]
    if not len(found):
        return ""
    at_x, at_y = _scaled(x[found], _LEFT, _WIDTH - _LEFT), _scaled(y[found], _HEIGHT - _BOTTOM - 3, _TOP + 3)
    points = [
        f'<circle class="{"ok" if good else "bad"}" cx="{a:.1f}" cy="{b:.1f}" r="2"/>'
        for a, b, good in zip(at_x, at_y, is_ok[found], strict=True)
    ]
    low, high = float(x[found].min()), float(x[found].max())
    return _svg([*points, *_axis(low, high)], f"{len(found)} points")


def correlation_bars(rows: Sequence[tuple[str, float | None]]) -> str:
    """Draw rank correlations, the strongest first."""
    strongest = sorted(rows, key=lambda each: -abs(each[1] or 0.0))
    lines: list[str] = []
    for name, value in strongest:
        share = 50 * abs(value or 0.0)
        left = 50 - share if (value or 0.0) < 0 else 50
        number = "constant" if value is None else f"{value:+.2f}"
        bar = f'<span class="bar"><i style="left:{left:.1f}%;width:{share:.1f}%"></i></span>'
        lines.append(f"<tr><th>{escape(name)}</th><td>{bar}</td><td>{number}</td></tr>")
    return f'<table class="correlations">{"".join(lines)}</table>'


def _scaled(values: NDArray[np.float64], first: float, last: float) -> list[float]:
    low, high = values.min(), values.max()
    share = (values - low) / (high - low) if high > low else np.full(len(values), 0.5)
    return (first + share * (last - first)).tolist()


def _bar(x: float, y: float, width: float, height: float, kind: str, said: str) -> str:
    if not height:
        return ""
    box = f'x="{x + 0.5:.1f}" y="{y:.1f}" width="{max(width - 1, 0.5):.1f}" height="{height:.1f}"'
    return f'<rect class="{kind}" {box}>{said}</rect>'


def _axis(low: float, high: float) -> list[str]:
    y = _HEIGHT - _BOTTOM
    return [
        f'<line x1="{_LEFT}" y1="{y}" x2="{_WIDTH - _LEFT}" y2="{y}"/>',
        f'<text x="{_LEFT}" y="{_HEIGHT - 4}">{low:.4g}</text>',
        f'<text x="{_WIDTH - _LEFT}" y="{_HEIGHT - 4}" text-anchor="end">{high:.4g}</text>',
    ]


def _svg(parts: list[str], title: str) -> str:
    size = f'viewBox="0 0 {_WIDTH:g} {_HEIGHT:g}"'
    return f'<svg {size} role="img" aria-label="{escape(title)}">{"".join(parts)}</svg>'
