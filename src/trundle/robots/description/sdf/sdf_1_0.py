"""Conversion of SDF 1.0, which wrote values as attributes, to the form of 1.2 and later."""

from trundle.base.xmlnode import XmlNode

_KEPT = frozenset({"name", "type", "version", "filename", "default", "id", "world_name"})
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
_NAMES = {"origin": "pose"}


def rewrite_old_style(root: XmlNode) -> None:
    """Convert a whole file; attributes without a counterpart stay and are reported as unsupported."""
    root.attributes_to_children(_KEPT, _TEXTS)
    root.rename(_NAMES)
