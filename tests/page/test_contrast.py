"""Text and shapes have WCAG's contrast on every ground, computed from the design's tokens."""

import itertools
import re
from pathlib import Path

import pytest

_STYLES = Path(__file__).parents[2] / "web/src"
_TOKENS = _STYLES / "theme/tokens.css"
_TEXT, _SHAPE = 4.5, 3.0
"""WCAG 2.2, 1.4.3 (AA) and 1.4.11."""

Rgba = tuple[float, float, float, float]

_PLAIN = ("panel", "panel-glass", "bar-bg", "sunken", "raised")
_LIT = ("hover", "accent-soft")
_GROUNDS = (*itertools.product(_PLAIN), *itertools.product(_PLAIN, _LIT))
_PAIRS = {
    "text": _GROUNDS,
    "text-2": _GROUNDS,
    "text-3": (*itertools.product(_PLAIN), ("panel", "hover"), ("bar-bg", "hover"), ("sunken", "hover")),
    "accent": (*itertools.product(_PLAIN), *itertools.product(("panel", "bar-bg", "raised"), _LIT)),
    "warn": (*itertools.product(_PLAIN), *itertools.product(("panel",), _LIT)),
    "error": (*itertools.product(_PLAIN), *itertools.product(("panel",), _LIT)),
    "on-accent": (("accent-fill",),),
    "on-person": tuple((f"person-{number}",) for number in range(1, 7)),
}
"""Tokens of texts, and the grounds below them: a layer, and what lies over it."""
_SHAPES = ("ok", "warn", "error", "none", "record", "edge", "accent", "accent-fill", "x", "y", "z", "focus")
_SHAPE_GROUNDS = ("panel", "panel-glass", "bar-bg", "sunken", "raised")
_DECORATION = (
    "line-soft",
    "line-hard",
    "c",
    "ax",
    "part",
    "scene",
    "edge",
    "record",
    "accent",
    "accent-fill",
    "ok",
    "reference",
)
"""Backgrounds that carry no text."""


def _tokens(theme: str) -> dict[str, Rgba]:
    dark, light = _TOKENS.read_text().split('[data-theme="light"] {')
    texts = (dark,) if theme == "dark" else (dark, light)
    found = [pair for text in texts for pair in re.findall(r"--([\w-]+):\s*#([0-9a-f]{3,8})\b", text)]
    return {name: _rgba(digits) for name, digits in found}


def _rgba(digits: str) -> Rgba:
    full = "".join(digit * 2 for digit in digits) if len(digits) in (3, 4) else digits
    red, green, blue, alpha = (int(f"{full}ff"[i : i + 2], 16) / 255 for i in range(0, 8, 2))
    return red, green, blue, alpha


def _over(layer: Rgba, below: Rgba) -> Rgba:
    alpha = layer[3]
    red, green, blue = (alpha * one + (1 - alpha) * other for one, other in zip(layer[:3], below[:3], strict=True))
    return red, green, blue, 1.0


def _luminance(color: Rgba) -> float:
    """Return WCAG's relative luminance."""
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in color[:3]]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def _contrast(token: str, ground: tuple[str, ...], colors: dict[str, Rgba]) -> float:
    """Return the smallest contrast on a ground, whose lowest layer the brightest or darkest scene may show through."""
    contrasts = []
    for scene in ((0.0, 0.0, 0.0, 1.0), (1.0, 1.0, 1.0, 1.0)):
        below: Rgba = scene
        for layer in ground:
            below = _over(colors[layer], below)
        bright, dim = sorted((_luminance(colors[token]), _luminance(below)), reverse=True)
        contrasts.append((bright + 0.05) / (dim + 0.05))
    return min(contrasts)


def _weak(pairs: dict[str, tuple[tuple[str, ...], ...]], least: float, theme: str) -> list[str]:
    colors = _tokens(theme)
    return [
        f"{token} on {' + '.join(ground)}: {contrast:.2f}"
        for token, grounds in pairs.items()
        for ground in grounds
        if (contrast := _contrast(token, ground, colors)) < least
    ]


@pytest.mark.parametrize("theme", ["dark", "light"])
def test_texts_and_shapes_stand_out_from_their_grounds(theme: str) -> None:
    assert _weak(_PAIRS, _TEXT, theme) == []
    assert _weak({shape: tuple((ground,) for ground in _SHAPE_GROUNDS) for shape in _SHAPES}, _SHAPE, theme) == []


def test_a_weak_pair_is_found() -> None:
    """In the dark theme the weakest text does not stand out from a selected row, whose texts are stronger."""
    assert _weak({"text-3": (("panel", "accent-soft"),)}, _TEXT, "dark") == ["text-3 on panel + accent-soft: 4.25"]


def test_the_pairs_have_every_token_of_the_style_sheets() -> None:
    styles = "\n".join(file.read_text() for file in _STYLES.rglob("*.css") if file != _TOKENS)
    texts = set(re.findall(r"(?<![\w-])(?:color|fill): var\(--([\w-]+)", styles))
    grounds = {
        token
        for value in re.findall(r"(?<![\w-])background(?:-color)?: ([^;}]+)", styles)
        for token in re.findall(r"var\(--([\w-]+)", value)
    }

    known = {layer for ground in (*_GROUNDS, *itertools.chain(*_PAIRS.values())) for layer in ground}
    assert texts <= {*_PAIRS, *_SHAPES, *known}
    assert grounds <= {*known, *_DECORATION, *_PAIRS}
