"""A plugin tag, kept as the author wrote it."""

from msgspec import Struct

from trundle.diagnostics import Source
from trundle.xmlnode import XmlNode


class PluginTag(Struct, frozen=True, kw_only=True):
    """Names the plugin a model, world or sensor asks for; `plugins` looks for it."""

    name: str
    filename: str
    """As written: a bare `libx.so` or a path on the author's machine."""
    at: Source
    node: XmlNode
    """The element, for the plugin to read its parameters from."""
