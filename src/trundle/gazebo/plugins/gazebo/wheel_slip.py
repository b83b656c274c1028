"""libWheelSlipPlugin.so: tyres whose slip grows with their force."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

from trundle.base.diagnostics import UsageError
from trundle.robots.model import Cylinder, Joint, JointType, PluginTag, Sphere
from trundle.robots.names import ros_name
from trundle.robots.parameters import TagParameters
from trundle.ros import Node, Publisher
from trundle.sim.physics import WheelGrip
from trundle.sim.simulation import LinkHandle, ModelHandle, Simulation
from trundle.spatial import Vector3, cross, dot, normalized

from ..plugin import Plugin

if TYPE_CHECKING:
    from trundle.ros.message_types import std_msgs


@dataclass(slots=True, eq=False)
class _Wheel:
    link: LinkHandle
    axis: Vector3
    """Axle in the link's frame."""
    radius: float
    """Radius [m]."""
    normal_force: float
    """Load of the wheel [N]."""
    lateral: float
    longitudinal: float
    """Slip compliance: slip ratio over force ratio."""
    topic: Publisher | None = None


class WheelSlip(Plugin):
    """Lets wheels slip, along and across, by compliance · tread speed / normal force per newton.

    Parameters, of any number of <wheel link_name="…">: <slip_compliance_lateral>, <slip_compliance_longitudinal> (0: no
    slip), <wheel_normal_force> [N] (required, about the wheel's load) and <wheel_radius> [m], else that of its
    only collision, a cylinder or sphere. `/<model>/wheel_slip/<link>` has each wheel's slip (geometry_msgs/Vector3: x
    along, y across, z tread speed [m/s]); `…/lateral_compliance` and `…/longitudinal_compliance` (Float64) set all
    wheels'. The axle is the first friction direction; <fdir1> is ignored. A contact sticks if its slip is less than a
    tenth of the velocity change that its force causes within a step.
    """

    def __init__(self, model: ModelHandle, node: Node | None, parameters: TagParameters, sim: Simulation) -> None:
        self._model = model
        self._down = model.pose.inverse().transform_vector(normalized(sim.world.physics.gravity) or (0.0, 0.0, -1.0))
        self._wheels: list[_Wheel] = []
        for wheel in parameters.sections("wheel"):
            try:
                self._wheels.append(_read(wheel, model))
            except UsageError as error:
                wheel.warn(f"<wheel>: {error}; it does not slip")
        if node is not None:
            base = f"/{ros_name(model.name)}/wheel_slip"
            for wheel in self._wheels:
                topic = f"{base}/{ros_name(wheel.link.name)}"
                wheel.topic = node.advertise(topic, "geometry_msgs/Vector3", queue_size=10)
            node.subscribe(f"{base}/lateral_compliance", "std_msgs/Float64", self._on_lateral)
            node.subscribe(f"{base}/longitudinal_compliance", "std_msgs/Float64", self._on_longitudinal)
        self.set_compliance()

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """See `Plugin.load`."""
        parameters = TagParameters(tag.node, sim.report)
        plugin = cls(model, node, parameters, sim)
        parameters.report_unread()
        return plugin

    def set_compliance(self, *, lateral: float = -1.0, longitudinal: float = -1.0) -> None:
        """Set all wheels' compliances; a negative value leaves them unchanged."""
        for wheel in self._wheels:
            wheel.lateral = lateral if lateral >= 0.0 else wheel.lateral
            wheel.longitudinal = longitudinal if longitudinal >= 0.0 else wheel.longitudinal
            per_turn = wheel.radius / wheel.normal_force
            wheel.link.set_surface_motion(
                WheelGrip(axis=wheel.axis, slip=per_turn * wheel.lateral, slip_across=per_turn * wheel.longitudinal)
            )

    def is_active(self) -> bool:
        """True if there is a subscriber; the slip itself needs no hook."""
        return any(wheel.topic is not None and wheel.topic.has_subscribers for wheel in self._wheels)

    def before_step(self, sim: Simulation) -> None:
        """Publish each wheel's slip."""
        del sim
        for wheel in self._wheels:
            if wheel.topic is None:
                continue
            twist, axis = wheel.link.twist, wheel.link.pose.transform_vector(wheel.axis)
            tread = wheel.radius * dot(twist.angular, axis)
            along = self._model.pose.transform_vector(
                cross(self._down, self._model.pose.inverse().transform_vector(axis))
            )
            wheel.topic.publish({"x": dot(along, twist.linear) - tread, "y": dot(axis, twist.linear), "z": tread})

    def _on_lateral(self, message: "std_msgs.Float64") -> None:
        self.set_compliance(lateral=max(float(message.data), 0.0))

    def _on_longitudinal(self, message: "std_msgs.Float64") -> None:
        self.set_compliance(longitudinal=max(float(message.data), 0.0))


def _read(parameters: TagParameters, model: ModelHandle) -> _Wheel:
    """Read one wheel.

    Raises:
        UsageError: a required value is missing.
    """
    link = model.link(parameters.attribute("link_name"))
    radius = parameters.number("wheel_radius", 0.0)
    normal_force = parameters.number("wheel_normal_force", above=0.0)
    lateral = parameters.number("slip_compliance_lateral", 0.0)
    longitudinal = parameters.number("slip_compliance_longitudinal", 0.0)
    parameters.report_unread()
    joints = [joint.joint for joint in model.joints if joint.joint.child == link.name]
    if len(joints) != 1 or joints[0].axis is None:
        raise UsageError(f"link {link.name!r} is the child of {len(joints)} joints with an axis; one is needed")
    if radius <= 0.0:
        radius = _radius(link)
    return _Wheel(link, _axis_in_link(joints[0], link), radius, normal_force, max(lateral, 0.0), max(longitudinal, 0.0))


def _radius(link: LinkHandle) -> float:
    shapes = [collision.geometry for collision in link.link.collisions]
    if len(shapes) == 1 and isinstance(shapes[0], Cylinder | Sphere):
        return shapes[0].radius
    raise UsageError(f"link {link.name!r} is not a single cylinder or sphere; <wheel_radius> is needed")


def _axis_in_link(joint: Joint, link: LinkHandle) -> Vector3:
    axis = joint.axis2 if joint.type is JointType.REVOLUTE2 and joint.axis2 is not None else joint.axis
    assert axis is not None
    return link.link.model_from_link.inverse().transform_vector(axis.direction)
