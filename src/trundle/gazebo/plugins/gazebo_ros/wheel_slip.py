"""libgazebo_ros_wheel_slip.so: libWheelSlipPlugin.so with dynamic_reconfigure."""

from typing import Self

from trundle.robots.model import PluginTag
from trundle.robots.names import ros_name
from trundle.robots.parameters import TagParameters
from trundle.ros import Node, Option, Options, ReconfigureServer
from trundle.sim.simulation import ModelHandle, Simulation

from ..gazebo.wheel_slip import WheelSlip

_UNCHANGED = -1.0
_MAX_COMPLIANCE = 20.0
"""Upper bound of compliances, from gazebo_plugins."""


class RosWheelSlip(WheelSlip):
    """`WheelSlip` with dynamic_reconfigure options at `/<model>/<robotNamespace>`, `wheel_slip` by default.

    `slip_compliance_unitless_lateral` and `slip_compliance_unitless_longitudinal` set all wheels'; -1: as in the file.
    """

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """See `Plugin.load`."""
        namespace = TagParameters(tag.node, sim.report).text("robotNamespace", "").strip("/") or "wheel_slip"
        plugin = super().load(sim, model, node, tag)
        if node is not None:
            plugin._offer(node, f"/{ros_name(model.name)}/{namespace}")
        return plugin

    def _offer(self, node: Node, namespace: str) -> None:
        directions = ("lateral", "longitudinal")
        options = [
            Option(
                name=f"slip_compliance_unitless_{direction}",
                value=_UNCHANGED,
                lower=_UNCHANGED,
                upper=_MAX_COMPLIANCE,
                description=f"Unitless slip compliance (slip / friction) in the {direction} direction",
            )
            for direction in directions
        ]

        def apply(values: Options) -> Options:
            lateral, longitudinal = (float(values[option.name]) for option in options)
            self.set_compliance(lateral=lateral, longitudinal=longitudinal)
            return values

        ReconfigureServer(node, options, apply, namespace=namespace)
