"""Colors and texture of a material from script blocks."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from trundle.robots.model import Rgba

from .script import Block

_MAX_ANCESTORS = 32
_COLORS = ("ambient", "diffuse", "specular", "emissive")


@dataclass(frozen=True, slots=True, kw_only=True)
class OgreSurface:
    """First pass of a material's first technique, with Ogre's defaults."""

    ambient: Rgba = (1.0, 1.0, 1.0, 1.0)
    diffuse: Rgba = (1.0, 1.0, 1.0, 1.0)
    specular: Rgba = (0.0, 0.0, 0.0, 1.0)
    emissive: Rgba = (0.0, 0.0, 0.0, 1.0)
    texture: str | None = None
    """File name without folder."""
    texture_scale: tuple[float, float] = (1.0, 1.0)


def read_surface(name: str, materials: Mapping[str, Block]) -> OgreSurface:
    """Read a material with its inherited values.

    Args:
        name: a key of `materials`.
        materials: every material block, by name.
    """
    colors: dict[str, Rgba] = {}
    texture: str | None = None
    scale = (1.0, 1.0)
    aliases: dict[str, str] = {}
    slot = ""
    for block in _ancestry(name, materials):
        for words in block.statements:
            if words[0] == "set_texture_alias" and len(words) == 3:
                aliases[words[1]] = words[2]
        passes = [
            technique_pass for technique in block.all("technique")[:1] for technique_pass in technique.all("pass")
        ]
        for technique_pass in passes[:1]:
            for keyword in _COLORS:
                color = _color(technique_pass.value(keyword), with_shininess=keyword == "specular")
                if color is not None:
                    colors[keyword] = color
        for unit in [unit for technique_pass in passes for unit in technique_pass.all("texture_unit")][:1]:
            alias = unit.value("texture_alias")
            slot = alias[0] if alias else (unit.header[1] if len(unit.header) > 1 else slot)
            file = unit.value("texture")
            texture = file[0] if file else texture
            scale = _scale(unit.value("scale")) or scale
    return OgreSurface(**colors, texture=aliases.get(slot, texture), texture_scale=scale)


def _ancestry(name: str, materials: Mapping[str, Block]) -> Iterator[Block]:
    """Return the material's ancestors, eldest first, and the material itself."""
    ancestors: list[Block] = []
    while name in materials and len(ancestors) < _MAX_ANCESTORS and materials[name] not in ancestors:
        ancestors.append(materials[name])
        name = parent_of(materials[name]) or ""
    return reversed(ancestors)


def name_of(material: Block) -> str:
    """Return the words between `material` and a colon."""
    return " ".join(_halves(material)[0])


def parent_of(material: Block) -> str | None:
    """Return the words after the colon."""
    return " ".join(_halves(material)[1]) or None


def _halves(material: Block) -> tuple[list[str], list[str]]:
    words = list(material.header[1:])
    if ":" not in words:
        return words, []
    colon = words.index(":")
    return words[:colon], words[colon + 1 :]


def _color(words: tuple[str, ...] | None, *, with_shininess: bool) -> Rgba | None:
    try:
        values = [float(word) for word in words or ()]
    except ValueError:  # the word "vertexcolour"
        return None
    if with_shininess and len(values) in (4, 5):
        values.pop()
    if len(values) not in (3, 4) or not all(map(math.isfinite, values)):
        return None
    r, g, b, a = (min(max(value, 0.0), 1.0) for value in (*values, 1.0)[:4])
    return (r, g, b, a)


def _scale(words: tuple[str, ...] | None) -> tuple[float, float] | None:
    try:
        across, up = map(float, words or ())
    except ValueError:
        return None
    return (across, up) if math.isfinite(across) and math.isfinite(up) and across * up != 0.0 else None
