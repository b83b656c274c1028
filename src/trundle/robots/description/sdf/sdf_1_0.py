"""Conversion of SDF 1.0, with values as attributes, to the syntax of SDF 1.2."""

from trundle.base.xmlnode import XmlNode

_ATTRIBUTES = frozenset({"name", "type", "version", "filename", "default", "id", "world_name"})
_TEXTS = {
    "origin": "pose",
    "parent": "link",
    "child": "link",
    "gravity": "xyz",
    "magnetic_field": "xyz",
    "direction": "xyz",
    "point": "xyz",
    "ambient": "rgba",
    "diffuse": "rgba",
    "specular": "rgba",
    "emissive": "rgba",
    "background": "rgba",
    "color": "rgba",
    "horizontal_fov": "angle",
    "shadows": "enabled",
    "grid": "enabled",
}
_RENAMED = {"origin": "pose"}


def rewrite_old_style(root: XmlNode) -> None:
    """Convert a whole file; attributes without a counterpart stay and are reported as unsupported."""
    root.attributes_to_children(_ATTRIBUTES, _TEXTS)
    root.rename(_RENAMED)
