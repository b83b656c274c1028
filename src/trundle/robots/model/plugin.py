"""Plugin tags, as written."""

from msgspec import Struct

from trundle.base.diagnostics import Source
from trundle.base.xmlnode import XmlNode


class PluginTag(Struct, frozen=True, kw_only=True):
    """Plugin of a model, world or sensor; `plugins` finds it by its file name."""

    __module__ = "trundle"

    name: str
    filename: str
    """As written: a bare `libx.so` or a path on the author's machine."""
    at: Source
    node: XmlNode
    """XML element with the plugin's parameters."""
