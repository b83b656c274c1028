"""Reader of labels and temperatures for segmentation and thermal cameras: gz's Label and Thermal plugins."""

from msgspec.structs import replace

from trundle.base.diagnostics import Diagnostics
from trundle.base.xmlnode import XmlNode
from trundle.robots.model import Model, PluginTag, Visual

from .context import Context
from .sensor import read_plugin

_MAX_LABEL = 255
_MAX_TEMPERATURE = 1e6
"""[K]"""


def with_plugins(visual: Visual, nodes: list[XmlNode], context: Context) -> Visual:
    """Return a visual with its plugins; Label and Thermal are applied."""
    plugins: list[PluginTag] = []
    for node in nodes:
        if _is_system(node, "label"):
            visual = replace(visual, label=_label(node, context.report))
        elif _is_system(node, "thermal"):
            visual = replace(visual, temperature=_temperature(node, context.report))
        else:
            plugins.append(read_plugin(node))
    return replace(visual, plugins=(*visual.plugins, *plugins))


def _temperature(node: XmlNode, report: Diagnostics) -> float | None:
    temperature = node.number("temperature", default=0.0)
    if 0.0 <= temperature <= _MAX_TEMPERATURE:
        return temperature
    report.warn(
        node.at, f"a temperature of {temperature:g} K is not possible; it is as warm as the air", "out-of-range"
    )
    return None


def labelled(model: Model, plugins: list[XmlNode], context: Context) -> Model:
    """Return a model with its own Label plugin applied to every visual without a label."""
    labels = [_label(node, context.report) for node in plugins if is_label(node)]
    if not labels:
        return model
    links = tuple(
        replace(link, visuals=tuple(v if v.label else replace(v, label=labels[-1]) for v in link.visuals))
        for link in model.links
    )
    return replace(model, links=links)


def is_label(node: XmlNode) -> bool:
    """True if a <plugin> is gz's Label."""
    return _is_system(node, "label")


def _is_system(node: XmlNode, system: str) -> bool:
    file, name = node.attribute("filename") or "", node.attribute("name") or ""
    return file.removesuffix(".so").endswith(f"-{system}-system") or name.endswith(f"systems::{system.capitalize()}")


def _label(node: XmlNode, report: Diagnostics) -> int:
    label = node.integer("label", default=0)
    if 0 <= label <= _MAX_LABEL:
        return label
    report.warn(node.at, f"label {label} is not between 0 and {_MAX_LABEL}; 0 is used", "out-of-range")
    return 0
