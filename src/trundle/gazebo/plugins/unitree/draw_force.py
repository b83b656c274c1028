"""libunitreeDrawForcePlugin.so: the force on a foot, as a line."""

from typing import TYPE_CHECKING, Self

from trundle.robots.description import GAZEBO_MATERIALS
from trundle.robots.model import Box, Cylinder, Geometry, MeshFile, Plane, PluginTag, Sphere, Visual
from trundle.robots.parameters import TagParameters
from trundle.ros import Node, Subscription
from trundle.sim.simulation import DebugLine, LinkHandle, ModelHandle, Simulation
from trundle.spatial import ZERO, Vector3

from ..plugin import VisualPlugin

if TYPE_CHECKING:
    from trundle.ros.message_types import geometry_msgs

_NEWTONS_PER_UNIT = 20.0


class DrawForce(VisualPlugin):
    """Draws a line from a visual's origin along the force of geometry_msgs/WrenchStamped on <topicName>/the_force.

    A relative name is below /visual, as for foot contacts; the default is /default_force_draw. As in
    Gazebo the line is in the visual's axes and scaled with it (0.05 m/N for a sphere of 1 m diameter, 0.001 m/N for
    0.02 m), and only the page shows it, not cameras (GZ_VISIBILITY_GUI). It subscribes once a page shows lines.
    """

    period_ns = 20_000_000
    """About the frame period of the page [ns]."""

    def __init__(
        self, sim: Simulation, model: ModelHandle, link: LinkHandle, visual: Visual, node: Node | None, tag: PluginTag
    ) -> None:
        """See `VisualPlugin.load`."""
        parameters = TagParameters(tag.node, sim.report)
        topic = parameters.text("topicName", "/default_force_draw")
        parameters.report_unread()
        self._topic = f"{topic if topic.startswith('/') else f'/visual/{topic}'}/the_force"
        self._node = node
        self._subscription: Subscription | None = None
        self._link = link
        self._link_from_visual = visual.link_from_visual
        self._scale = _node_scale(visual.geometry)
        self._force = ZERO
        self._line = DebugLine(GAZEBO_MATERIALS["Gazebo/Purple"].diffuse[:3])
        sim.lines[f"{model.name}::{link.name}::{visual.name}::{tag.name}"] = self._line

    @classmethod
    def load(
        cls, sim: Simulation, model: ModelHandle, link: LinkHandle, visual: Visual, node: Node | None, tag: PluginTag
    ) -> Self:
        """See `VisualPlugin.load`."""
        return cls(sim, model, link, visual, node, tag)

    def before_step(self, sim: Simulation) -> None:
        """Update the line to the visual's pose."""
        if self._node is None or not sim.lines_are_shown:
            return
        if self._subscription is None:
            kind = "geometry_msgs/WrenchStamped"
            self._subscription = self._node.subscribe(self._topic, kind, self._on_force, queue_size=30)
        x, y, z = (force * scale / _NEWTONS_PER_UNIT for force, scale in zip(self._force, self._scale, strict=True))
        world_from_visual = self._link.pose @ self._link_from_visual
        self._line.points[:] = [world_from_visual.position, world_from_visual.transform_point((x, y, z))]

    def _on_force(self, message: "geometry_msgs.WrenchStamped") -> None:
        force = message.wrench.force
        self._force = (force.x, force.y, force.z)


def _node_scale(geometry: Geometry) -> Vector3:
    """Return the scale of a visual's node, with which Gazebo draws unit shapes and attached objects (Visual::Load)."""
    match geometry:
        case Box(size):
            return size
        case Sphere(radius):
            return (2.0 * radius, 2.0 * radius, 2.0 * radius)
        case Cylinder(radius, length):
            return (2.0 * radius, 2.0 * radius, length)
        case Plane(_, (x, y)):
            return (x, y, 1.0)
        case MeshFile():
            return geometry.scale
        case _:
            return (1.0, 1.0, 1.0)
