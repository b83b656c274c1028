"""libgazebo_ros_wheel_slip.so: Gazebo's tyres, whose compliance users change while they run."""

from typing import Self

from trundle.model import PluginTag
from trundle.names import ros_name
from trundle.ros import Node, Option, Options, ReconfigureServer
from trundle.simulation import ModelHandle, Simulation

from ..gazebo.wheel_slip import WheelSlip

_AS_THEY_ARE = -1.0
_MOST = 20.0
"""gazebo_plugins' bound."""


class RosWheelSlip(WheelSlip):
    """As `WheelSlip`, with options of dynamic_reconfigure at `/<model>/<robotNamespace>`, `wheel_slip` by default.

    They are all wheels' `slip_compliance_unitless_lateral` and `slip_compliance_unitless_longitudinal`; -1: as the file
    says.
    """

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """See `Plugin.load`."""
        namespace = tag.node.string("robotNamespace", default="").strip("/") or "wheel_slip"
        plugin = super().load(sim, model, node, tag)
        if node is not None:
            plugin._offer(node, f"/{ros_name(model.name)}/{namespace}")
        return plugin

    def _offer(self, node: Node, namespace: str) -> None:
        ways = ("lateral", "longitudinal")
        options = [
            Option(
                name=f"slip_compliance_unitless_{way}",
                value=_AS_THEY_ARE,
                lower=_AS_THEY_ARE,
                upper=_MOST,
                description=f"Unitless slip compliance (slip / friction) in the {way} direction",
            )
            for way in ways
        ]

        def apply(values: Options) -> Options:
            lateral, longitudinal = (float(values[option.name]) for option in options)
            self.set_compliance(lateral=lateral, longitudinal=longitudinal)
            return values

        ReconfigureServer(node, options, apply, namespace=namespace)
