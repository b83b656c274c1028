"""Base of gazebo_ros' model plugins, which need the ROS graph."""

from typing import Self

from trundle.base.diagnostics import TrundleError
from trundle.robots.model import PluginTag
from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import ModelHandle, Simulation

from ..plugin import Plugin
from .namespaces import WITHOUT_EFFECT
from .plugin_names import PluginNames


def plugin_names(sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> PluginNames:
    """Return the names of a model's plugin."""
    return PluginNames(node, parameters, model.model, [other.model for other in sim.models])


class RosPlugin(Plugin):
    """Plugin that reads its parameters in `__init__`; `load` then reports unread ones."""

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        """Read the parameters, advertise and subscribe."""

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """See `Plugin.load`."""
        if node is None:
            raise TrundleError("it needs the ROS graph, which --no-ros leaves out")
        parameters = TagParameters(tag.node, sim.report)
        plugin = cls(sim, model, node, parameters)
        parameters.ignore(*WITHOUT_EFFECT)
        parameters.report_unread()
        return plugin
