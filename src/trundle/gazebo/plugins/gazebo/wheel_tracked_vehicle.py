"""libWheelTrackedVehiclePlugin.so: tracks as rows of wheels."""

from typing import Self

from trundle.robots.model import Cylinder, PluginTag
from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import JointHandle, ModelHandle, Simulation

from ..plugin import Plugin
from .bounding_box import bounding_box
from .tracked_vehicle import Tracks


class WheelTrackedVehicle(Plugin):
    """Drives all wheels of a side at one track speed.

    Parameters: two or more <left_joint> and <right_joint> each, <max_torque> [N·m] (5) of each wheel, and those of
    `Tracks`. A wheel's radius is that of its single cylinder, else half the largest side of its bounding box.
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> None:
        self._tracks = Tracks(sim, model, node, tag)
        parameters = TagParameters(tag.node, sim.report)
        self._torque = parameters.number("max_torque", 5.0)
        sides = [[model.joint(name) for name in parameters.texts(f"{side}_joint")] for side in ("left", "right")]
        for side, joints in zip(("left", "right"), sides, strict=True):
            if len(joints) < 2:
                problem = f"plugin {tag.name!r} needs two or more <{side}_joint>, got {len(joints)}"
                parameters.warn(f"{problem}; it drives these")
        parameters.report_unread()
        self._wheels = [[(joint, _radius(model, joint)) for joint in joints] for joints in sides]
        self._tracks.set_friction(sim, [model.link(joint.joint.child) for joints in sides for joint in joints])

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """See `Plugin.load`."""
        return cls(sim, model, node, tag)

    def before_step(self, sim: Simulation) -> None:
        """Set all wheels' speeds."""
        del sim
        for speed, wheels in zip(self._tracks.speeds, self._wheels, strict=True):
            for joint, radius in wheels:
                joint.command_velocity(speed / radius, max_effort=self._torque)

    def reset(self) -> None:
        """Stop."""
        self._tracks.command.stop()


def _radius(model: ModelHandle, joint: JointHandle) -> float:
    link = model.link(joint.joint.child).link
    if len(link.collisions) == 1 and isinstance(link.collisions[0].geometry, Cylinder):
        return link.collisions[0].geometry.radius
    return max(bounding_box(link)) / 2 or 1.0
