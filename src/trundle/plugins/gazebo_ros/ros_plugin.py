"""Base of gazebo_ros' model plugins, which need the ROS graph."""

from typing import Self

from trundle.diagnostics import TrundleError
from trundle.model import PluginTag
from trundle.ros import Node
from trundle.simulation import ModelHandle, Simulation
from trundle.xmlnode import XmlNode

from ..plugin import Plugin
from .namespaces import mark_read


class RosPlugin(Plugin):
    """Plugin that reads its parameters in `__init__`; unread ones are reported after it."""

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, tag: PluginTag) -> None:
        """See `Plugin.load`."""

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """See `Plugin.load`."""
        if node is None:
            raise TrundleError("it needs the ROS graph, which --no-ros leaves out")
        plugin = cls(sim, model, node, tag)
        mark_read(tag.node)
        tag.node.report_unread(sim.report)
        return plugin


def required(parameters: XmlNode, name: str) -> str:
    """Text of a required parameter.

    Raises:
        TrundleError: missing or empty.
    """
    text = parameters.string(name).strip()
    if not text:
        raise TrundleError(f"<{name}> is missing")
    return text
