"""Fields of plugins: their parameters, as documented and as the file has them."""

from trundle.base.xmlnode import XmlElement
from trundle.gazebo.plugins import plugin_documentation

from .field import Field, Section
from .shape_fields import NAME

_MAX_PARAMETERS = 100


def plugin_sections(plugin: XmlElement) -> list[Section]:
    """Return the sections of a <plugin>."""
    filename = plugin.get("filename") or ""
    documentation = plugin_documentation(filename.rpartition("/")[2])
    known = {} if documentation is None else {each.name: each.default for each in documentation.parameters}
    given = [child.tag for child in plugin.children if not child.children]
    names = list(dict.fromkeys([*given, *known]))[:_MAX_PARAMETERS]
    own = (NAME, Field(name="@filename", label="File name", kind="text"))
    parameters = tuple(Field(name=name, label=name, kind="text", default=known.get(name, "")) for name in names)
    return [Section(title="Plugin", fields=own), Section(title="Parameters", fields=parameters)]
