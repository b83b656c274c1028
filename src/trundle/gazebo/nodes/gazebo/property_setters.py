"""/gazebo's services that change properties of the running world, its links, joints and lights."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from msgspec.structs import replace

from trundle.base.diagnostics import UsageError
from trundle.robots.model import Inertial, Joint, JointAxis, Light, Link, Model
from trundle.ros import Message, Node
from trundle.spatial import Vector3

from ..host import Simulator
from .entities import find_joint, find_light, find_link
from .messages import advertise_status_service, read_pose, read_vector
from .ode import IGNORED, OdeSettings

if TYPE_CHECKING:
    from trundle.ros.message_types import gazebo_msgs, std_msgs
    from trundle.sim.simulation import Simulation

_NO_EQUIVALENT = ("erp", "cfm", "stop_erp", "stop_cfm", "fudge_factor")
"""Settings of ODE joints that have no equivalent in MuJoCo."""
_UPDATED = "physics engine updated"
MIN_STEP_S, MAX_STEP_S = 1e-6, 1.0
"""Limits of a world's <max_step_size>."""


def advertise_property_setters(node: Node, simulator: Simulator, ode: OdeSettings) -> None:
    """Advertise set_physics_, set_link_, set_joint_ and set_light_properties, and delete_light."""
    services = _PropertySetters(simulator, ode)
    for name, kind, handler, status_message in (
        ("set_physics_properties", "SetPhysicsProperties", services.set_physics_properties, _UPDATED),
        ("set_link_properties", "SetLinkProperties", services.set_link_properties, "SetLinkProperties: properties set"),
        (
            "set_joint_properties",
            "SetJointProperties",
            services.set_joint_properties,
            "SetJointProperties: properties set",
        ),
        (
            "set_light_properties",
            "SetLightProperties",
            services.set_light_properties,
            "SetLightProperties: properties set",
        ),
        ("delete_light", "DeleteLight", services.delete_light, "DeleteLight: successfully deleted light"),
    ):
        advertise_status_service(node, name, kind, handler, status_message)


def set_physics(simulator: Simulator, *, step_s: float, gravity: Vector3, rate_hz: float) -> None:
    """Set the step size [s], gravity [m/s²] and steps per second of wall time; 0: as fast as possible.

    Raises:
        UsageError: a value is out of range.
    """
    if not MIN_STEP_S <= step_s <= MAX_STEP_S:
        raise UsageError(f"time_step must be from {MIN_STEP_S:g} to {MAX_STEP_S:g} s, got {step_s:g}")
    if not all(math.isfinite(value) for value in (*gravity, rate_hz)) or rate_hz < 0.0:
        raise UsageError("gravity and max_update_rate must be finite, the rate not below 0")
    world = simulator.simulation.world
    previous = world.physics
    physics = replace(previous, max_step_size_s=step_s, gravity=gravity, real_time_update_rate_hz=rate_hz)
    simulator.do(lambda simulation: simulation.edit(replace(world, physics=physics)))
    speed = rate_hz * step_s
    if speed != previous.real_time_update_rate_hz * previous.max_step_size_s:
        simulator.set_speed(speed or None)


class _PropertySetters:
    def __init__(self, simulator: Simulator, ode: OdeSettings) -> None:
        self._simulator = simulator
        self._ode = ode

    def set_physics_properties(self, request: "gazebo_msgs.SetPhysicsPropertiesRequest") -> dict[str, Any]:
        """Set time step, gravity and update rate; ODE's settings are stored without effect."""
        set_physics(
            self._simulator,
            step_s=float(request.time_step),
            gravity=read_vector(request.gravity),
            rate_hz=float(request.max_update_rate),
        )
        ignored = self._ode.update_config(request.ode_config)
        note = f"{_UPDATED}; {IGNORED}{', '.join(ignored)}"
        return {"status_message": note} if ignored else {}

    def set_link_properties(self, request: "gazebo_msgs.SetLinkPropertiesRequest") -> dict[str, Any]:
        """Set mass, centre of mass, inertia, and whether gravity applies."""
        simulation = self._simulator.simulation
        handle = find_link(simulation, request.link_name)
        inertial = Inertial(
            mass=float(request.mass),
            link_from_com=read_pose(request.com),
            moments=(float(request.ixx), float(request.iyy), float(request.izz)),
            products=(float(request.ixy), float(request.ixz), float(request.iyz)),
        )
        if not inertial.mass > 0.0 or not all(moment > 0.0 for moment in inertial.moments):
            raise UsageError("a link's mass and its moments of inertia ixx, iyy and izz must be greater than 0")
        model = next(model.model for model in simulation.models if handle in model.links)
        link = replace(handle.link, inertial=inertial, gravity=bool(request.gravity_mode))
        self._replace_model(replace(model, links=_replace_by_name(model.links, link)))
        return {}

    def set_joint_properties(self, request: "gazebo_msgs.SetJointPropertiesRequest") -> dict[str, Any]:
        """Set damping and limits of each axis, and ODE's joint motor (fmax, vel)."""
        simulation = self._simulator.simulation
        handle = find_joint(simulation, request.joint_name)
        config = request.ode_joint_config
        for name in ("damping", "hiStop", "loStop", "fmax", "vel"):
            count = len(getattr(config, name))
            if count > len(handle.axes):
                raise UsageError(f"{name} has {count} values; the joint has {len(handle.axes)} axes")
        model = next((model.model for model in simulation.models if handle in model.joints), None)
        if model is None:
            raise UsageError(f"joint {handle.name!r} belongs to the world; its properties cannot be changed")
        joint = handle.joint
        changed = replace(joint, axis=_axis(joint, 0, config), axis2=_axis(joint, 1, config))
        if changed != joint:
            self._replace_model(replace(model, joints=_replace_by_name(model.joints, changed)))
        motors = [(float(effort), float(speed)) for effort, speed in zip(config.fmax, config.vel, strict=False)]

        def drive(_: "Simulation") -> None:
            for axis, (effort, speed) in enumerate(motors):
                handle.command_velocity(speed, max_effort=effort, axis=axis)

        if motors:
            self._simulator.do(drive)
        ignored = [name for name in _NO_EQUIVALENT if len(getattr(config, name))]
        note = f"SetJointProperties: properties set; without effect here: {', '.join(ignored)}"
        return {"status_message": note} if ignored else {}

    def set_light_properties(self, request: "gazebo_msgs.SetLightPropertiesRequest") -> dict[str, Any]:
        """Set colors, attenuation, pose and direction."""
        world = self._simulator.simulation.world
        light = find_light(world, request.light_name)
        direction = read_vector(request.direction)
        length = math.hypot(*direction)
        x, y, z = direction
        changed = replace(
            light,
            cast_shadows=bool(request.cast_shadows),
            diffuse=_color(request.diffuse),
            specular=_color(request.specular),
            constant=float(request.attenuation_constant),
            linear=float(request.attenuation_linear),
            quadratic=float(request.attenuation_quadratic),
            direction=(x / length, y / length, z / length) if length > 0.0 else light.direction,
            world_from_light=read_pose(request.pose),
        )
        self._replace_light(light, [changed])
        return {}

    def delete_light(self, request: "gazebo_msgs.DeleteLightRequest") -> dict[str, Any]:
        """Delete a light of the world."""
        self._replace_light(find_light(self._simulator.simulation.world, request.light_name), [])
        return {}

    def _replace_light(self, light: Light, replacements: list[Light]) -> None:
        world = self._simulator.simulation.world
        lights = tuple(
            item for existing in world.lights for item in (replacements if existing is light else [existing])
        )
        self._simulator.do(lambda simulation: simulation.edit(replace(world, lights=lights)))

    def _replace_model(self, model: Model) -> None:
        world = self._simulator.simulation.world
        models = tuple(model if other.name == model.name else other for other in world.models)
        self._simulator.do(lambda simulation: simulation.edit(replace(world, models=models)))


def _replace_by_name(parts: "Sequence[Link] | Sequence[Joint]", part: "Link | Joint") -> Any:
    return tuple(part if other.name == part.name else other for other in parts)


def _axis(joint: Joint, number: int, config: Message) -> JointAxis | None:
    axis = (joint.axis, joint.axis2)[number]
    if axis is None:
        return None

    def value(name: str, default: float) -> float:
        values = getattr(config, name)
        return float(values[number]) if len(values) > number else default

    lower, upper = value("loStop", axis.lower), value("hiStop", axis.upper)
    if not lower < upper:
        raise UsageError(f"loStop {lower:g} must be less than hiStop {upper:g}")
    damping = value("damping", axis.damping)
    if not (math.isfinite(damping) and damping >= 0.0):
        raise UsageError(f"damping must be 0 or more, got {damping:g}")
    return replace(axis, lower=lower, upper=upper, damping=damping)


def _color(color: "std_msgs.ColorRGBA") -> tuple[float, float, float, float]:
    return (float(color.r), float(color.g), float(color.b), float(color.a))
