"""/gazebo's services that return properties of the world, models, links, joints, lights and physics."""

import math
from typing import TYPE_CHECKING, Any

from trundle.robots.model import JointType
from trundle.ros import Node

from ..host import Simulator
from .entities import find_joint, find_light, find_link, find_model
from .messages import advertise_status_service, pose_fields, vector_fields
from .ode import OdeSettings

if TYPE_CHECKING:
    from trundle.ros.message_types import gazebo_msgs

_JOINT_TYPES = {
    JointType.REVOLUTE: 0,
    JointType.PRISMATIC: 2,
    JointType.FIXED: 3,
    JointType.BALL: 4,
    JointType.UNIVERSAL: 5,
}
_CONTINUOUS = 1


def advertise_property_getters(node: Node, simulator: Simulator, ode: OdeSettings) -> None:
    """Advertise the get_…_properties services."""
    properties = _PropertyGetters(simulator, ode)
    for name, kind, handler in (
        ("get_world_properties", "GetWorldProperties", properties.get_world_properties),
        ("get_model_properties", "GetModelProperties", properties.get_model_properties),
        ("get_link_properties", "GetLinkProperties", properties.get_link_properties),
        ("get_joint_properties", "GetJointProperties", properties.get_joint_properties),
        ("get_physics_properties", "GetPhysicsProperties", properties.get_physics_properties),
        ("get_light_properties", "GetLightProperties", properties.get_light_properties),
    ):
        advertise_status_service(node, name, kind, handler, f"{kind}: got properties")


class _PropertyGetters:
    def __init__(self, simulator: Simulator, ode: OdeSettings) -> None:
        self._simulator = simulator
        self._ode = ode

    def get_world_properties(self, _request: "gazebo_msgs.GetWorldPropertiesRequest") -> dict[str, Any]:
        simulation = self._simulator.simulation
        return {
            "sim_time": simulation.time_ns / 1e9,
            "model_names": [model.name for model in simulation.models],
            "rendering_enabled": True,
        }

    def get_model_properties(self, request: "gazebo_msgs.GetModelPropertiesRequest") -> dict[str, Any]:
        model = find_model(self._simulator.simulation, request.model_name)
        links = [link for link in model.links if "::" not in link.name]
        nested_links = [link for link in model.links if "::" in link.name]
        return {
            "canonical_body_name": model.links[0].name if model.links else "",
            "body_names": [link.name for link in links],
            "geom_names": [shape.name for link in links for shape in link.link.collisions],
            "joint_names": [joint.name for joint in model.joints if "::" not in joint.name],
            "child_model_names": list(dict.fromkeys(link.name.partition("::")[0] for link in nested_links)),
            "is_static": model.model.static,
        }

    def get_link_properties(self, request: "gazebo_msgs.GetLinkPropertiesRequest") -> dict[str, Any]:
        link = find_link(self._simulator.simulation, request.link_name).link
        inertial = link.inertial
        (ixx, iyy, izz), (ixy, ixz, iyz) = inertial.moments, inertial.products
        return {
            "com": pose_fields(inertial.link_from_com),
            "gravity_mode": link.gravity,
            "mass": inertial.mass,
            "ixx": ixx,
            "iyy": iyy,
            "izz": izz,
            "ixy": ixy,
            "ixz": ixz,
            "iyz": iyz,
        }

    def get_joint_properties(self, request: "gazebo_msgs.GetJointPropertiesRequest") -> dict[str, Any]:
        handle = find_joint(self._simulator.simulation, request.joint_name)
        joint = handle.joint
        is_continuous = joint.type is JointType.REVOLUTE and joint.axis is not None and joint.axis.upper == math.inf
        return {
            "type": _CONTINUOUS if is_continuous else _JOINT_TYPES.get(joint.type, _JOINT_TYPES[JointType.REVOLUTE]),
            "damping": [axis.damping for axis in (joint.axis, joint.axis2) if axis is not None],
            "position": list(handle.positions),
            "rate": list(handle.velocities),
        }

    def get_physics_properties(self, _request: "gazebo_msgs.GetPhysicsPropertiesRequest") -> dict[str, Any]:
        physics = self._simulator.simulation.world.physics
        return {
            "time_step": physics.max_step_size_s,
            "pause": self._simulator.paused,
            "max_update_rate": physics.real_time_update_rate_hz,
            "gravity": vector_fields(physics.gravity),
            "ode_config": self._ode.values,
        }

    def get_light_properties(self, request: "gazebo_msgs.GetLightPropertiesRequest") -> dict[str, Any]:
        light = find_light(self._simulator.simulation.world, request.light_name)
        return {
            "diffuse": dict(zip("rgba", light.diffuse, strict=True)),
            "attenuation_constant": light.constant,
            "attenuation_linear": light.linear,
            "attenuation_quadratic": light.quadratic,
        }
