"""Fields of plugins: documented parameters, and those in the file."""

from trundle.base.xmlnode import XmlElement
from trundle.gazebo.plugins import plugin_documentation

from .field import Field, Section
from .shape_fields import NAME

_MAX_PARAMETERS = 100


def plugin_sections(plugin: XmlElement) -> list[Section]:
    """Return the sections of a <plugin>."""
    filename = plugin.get("filename") or ""
    documentation = plugin_documentation(filename.rpartition("/")[2])
    parameters = () if documentation is None else documentation.parameters
    defaults = {parameter.name: parameter.default for parameter in parameters}
    in_file = [child.tag for child in plugin.children if not child.children]
    names = list(dict.fromkeys([*in_file, *defaults]))[:_MAX_PARAMETERS]
    plugin_fields = (NAME, Field(name="@filename", label="File name", kind="text"))
    fields = tuple(Field(name=name, label=name, kind="text", default=defaults.get(name, "")) for name in names)
    return [Section(title="Plugin", fields=plugin_fields), Section(title="Parameters", fields=fields)]
