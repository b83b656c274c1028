"""SDF 1.0, which wrote values as attributes: rewritten as 1.2 and later write them."""

from trundle.xmlnode import XmlNode

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
    """Rewrite a whole file; what has no counterpart stays as it is, to be named as not supported."""
    root.attributes_to_children(_KEPT, _TEXTS)
    root.rename(_NAMES)
