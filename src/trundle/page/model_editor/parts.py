"""Sections of fields for each part of a model."""

import re
from dataclasses import dataclass

from trundle.base.diagnostics import UsageError
from trundle.base.xmlnode import XmlElement
from trundle.page import Part
from trundle.robots.model import Link, Model

from .document import ModelDocument
from .field import Field, Section
from .joint_fields import joint_sections
from .link_fields import link_sections, model_sections
from .plugin_fields import plugin_sections
from .sensor_fields import sensor_sections
from .shape_fields import shape_sections

_PARAMETER = re.compile(r"[A-Za-z_][\w.-]{0,60}")


@dataclass(frozen=True, slots=True)
class ReadModel:
    """Document, and the model read from it."""

    document: ModelDocument
    model: Model
    """Flat model."""

    def link(self, part: Part) -> Link | None:
        """Return a link by its address; None if the part is not a link."""
        if part[-2:-1] != ("link",):
            return None
        name = "::".join(part[1::2])
        return next((link for link in self.model.links if link.name == name), None)

    def sections(self, part: Part, element: XmlElement) -> list[Section]:
        """Return the sections of a part."""
        match element.tag:
            case "link":
                return link_sections(element, self.link(part))
            case "joint":
                links = [link.name.removeprefix(_scope(part)) for link in self.model.links]
                return joint_sections(element, [name for name in links if "::" not in name or len(part) == 2])
            case "sensor":
                collisions = [element.get("name") or "" for element in self.document.find(part[:-2]).all("collision")]
                return sensor_sections(element, tuple(collisions))
            case "plugin":
                return plugin_sections(element)
            case "visual" | "collision":
                return shape_sections(element)
            case _:
                return model_sections()

    def field(self, part: Part, name: str) -> Field:
        """Return a field of a part; a plugin has fields for all parameters.

        Raises:
            UsageError: there is no such part or field.
        """
        element = self.document.find(part)
        for section in self.sections(part, element):
            for field in section.fields:
                if field.name == name:
                    return field
        if element.tag == "plugin" and _PARAMETER.fullmatch(name):
            return Field(name=name, label=name, kind="text")
        raise UsageError(f"a {element.tag} has no field {name!r}")


def _scope(part: Part) -> str:
    return "".join(f"{name}::" for name in part[1:-2:2])
