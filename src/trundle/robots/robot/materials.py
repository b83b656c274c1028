"""Reader of a URDF's <material> by urdfdom's rules: a color, a texture, or the name of an earlier one."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.base.xmlnode import XmlNode, parse_numbers

from .urdf_tree import Rgba


@dataclass(frozen=True, slots=True)
class RobotMaterial:
    """Color and texture of a material."""

    rgba: Rgba | None = None
    """None: no color."""
    texture: str = ""
    """URI of the texture, as written."""


class Materials:
    """Materials by name; a material defined in a link is available to later links."""

    def __init__(self, nodes: Iterable[XmlNode], report: Diagnostics) -> None:
        """Read the robot's materials."""
        self._report = report
        self._materials: dict[str, RobotMaterial] = {}
        for node in nodes:
            name = node.attribute("name")
            if name is None:
                report.warn(
                    node.at, "<material> without a name cannot be referenced; it is left out", "incomplete-element"
                )
                node.mark_all_read()
                continue
            if name in self._materials:
                raise DescriptionError(node.at, f"a second material {name!r}", "duplicate-name")
            self._materials[name] = self._read(node)

    def find(self, node: XmlNode) -> RobotMaterial:
        """Return the color and texture of a visual's <material>."""
        name, look = node.attribute("name") or "", self._read(node)
        if look == RobotMaterial():
            if name not in self._materials:
                self._report.warn(node.at, f"no material {name!r}; it has no color", "missing-material")
            return self._materials.get(name, look)
        if name:
            self._materials[name] = look
        return look

    def _read(self, node: XmlNode) -> RobotMaterial:
        texture, color = node.find("texture"), node.find("color")
        image = "" if texture is None else texture.attribute("filename") or ""
        return RobotMaterial(None if color is None else self._color(color), image)

    def _color(self, node: XmlNode) -> Rgba | None:
        text = node.attribute("rgba")
        values = parse_numbers(text or "")
        if values is None or len(values) != 4 or not all(map(math.isfinite, values)):
            self._report.warn(node.at, f"<color rgba={text!r}> needs four numbers; it is ignored", "invalid-value")
            return None
        r, g, b, a = (min(max(v, 0.0), 1.0) for v in values)
        return (r, g, b, a)
