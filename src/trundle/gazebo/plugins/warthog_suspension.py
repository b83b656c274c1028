"""libwarthog_suspension_plugin.so: springs and dampers between a Warthog's body and its two drive units."""

from typing import Self

from trundle.robots.model import PluginTag
from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import ModelHandle, Simulation

from .plugin import Plugin

_JOINTS = ("left_diff_unit_joint", "right_diff_unit_joint")


class WarthogSuspension(Plugin):
    """Drives `left_diff_unit_joint` and `right_diff_unit_joint` with −k q − b q̇ at every step.

    Parameters, with the original's defaults: <suspension_k> 0 [N·m/rad] and <suspension_b> 0 [N·m·s/rad].
    """

    def __init__(self, sim: Simulation, model: ModelHandle, tag: PluginTag) -> None:
        parameters = TagParameters(tag.node, sim.report)
        self._joints = [model.joint(name) for name in _JOINTS]
        self._stiffness = parameters.number("suspension_k", 0.0)
        self._damping = parameters.number("suspension_b", 0.0)
        parameters.ignore("robotNamespace", "namespace")
        parameters.report_unread()

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """See `Plugin.load`."""
        del node
        return cls(sim, model, tag)

    def before_step(self, sim: Simulation) -> None:
        """Apply the efforts."""
        del sim
        for joint in self._joints:
            joint.command_effort(-self._stiffness * joint.position - self._damping * joint.velocity)
