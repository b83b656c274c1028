"""Edits of a simulated world from the page, as commands that a timeline can repeat."""

import math

from msgspec.structs import replace

from trundle.base.diagnostics import UsageError
from trundle.page import (
    ApplyWrench,
    Carry,
    EditAction,
    HoldModel,
    LetGo,
    MoveJoint,
    PlaceJoint,
    PlaceLight,
    Pull,
    SetFriction,
    SetLight,
    SetMass,
    SetPhysics,
    SetPose,
    SetTwist,
)
from trundle.robots.model import Light, Link, Model, World
from trundle.sim.simulation import JointHandle, LinkHandle, ModelHandle, Simulation
from trundle.spatial import Pose, Quaternion, Twist, Vector3, Wrench

from .handling import carry, hold, let_go, move_model, pull

_JOINT_EFFORT = 10.0
"""Effort limit with which the page moves a joint that has none [N·m or N]."""


def edit(action: EditAction, simulation: Simulation) -> None:
    """Execute an edit.

    Raises:
        UsageError: there is no such model, link, joint or light, or the edit is not possible.
    """
    match action:
        case MoveJoint():
            _move_joint(action, simulation)
        case PlaceJoint(model, joint, position):
            _find_joint(simulation, model, joint).set_position(position)
        case Carry():
            carry(simulation, find_model(simulation, action.model), _model_pose(action, simulation))
        case SetPose():
            move_model(simulation, find_model(simulation, action.model), _model_pose(action, simulation))
        case Pull(model, link, point, target):
            pulled = _find_link(simulation, model, link)
            pull(simulation, find_model(simulation, model), pulled, point=point, target=target)
        case LetGo(model):
            let_go(simulation, find_model(simulation, model).name)
        case HoldModel(model, on):
            hold(simulation, find_model(simulation, model), on=on)
        case SetTwist(model, linear, angular):
            find_model(simulation, model).set_twist(Twist(linear, angular))
        case SetMass():
            _set_mass(action, simulation)
        case SetFriction():
            _set_friction(action, simulation)
        case SetLight():
            simulation.edit(_with_light(simulation.world, action))
        case PlaceLight():
            simulation.edit(_with_light_at(simulation.world, action))
        case SetPhysics():
            simulation.edit(_with_physics(simulation.world, action))
        case ApplyWrench(model, link, force, torque, duration_s):
            _find_link(simulation, model, link).apply_wrench(Wrench(force, torque), duration_s=duration_s)


def find_model(simulation: Simulation, name: str) -> ModelHandle:
    """Return a model; of a nested model, `outer::inner`, the outermost one."""
    outer = max((m.name for m in simulation.models if f"{name}::".startswith(f"{m.name}::")), key=len, default=name)
    return simulation[outer]


def _inner_name(model: ModelHandle, scope: str, name: str) -> str:
    """Return the name, relative to the outermost model, of a part in a nested model."""
    return f"{scope}::{name}".removeprefix(f"{model.name}::")


def _find_link(simulation: Simulation, scope: str, name: str) -> LinkHandle:
    model = find_model(simulation, scope)
    return model.link(_inner_name(model, scope, name))


def _find_joint(simulation: Simulation, scope: str, name: str) -> JointHandle:
    model = find_model(simulation, scope)
    return model.joint(_inner_name(model, scope, name))


def _move_joint(move: MoveJoint, simulation: Simulation) -> None:
    joint = _find_joint(simulation, move.model, move.joint)
    axis = joint.joint.axis
    effort = math.inf if axis is not None and math.isfinite(axis.effort) else _JOINT_EFFORT
    if move.position is not None:
        joint.command_position(move.position, max_effort=effort)
    elif move.velocity is not None:
        joint.command_velocity(move.velocity, max_effort=effort)
    elif move.effort is not None:
        joint.command_effort(move.effort)


def _model_pose(move: SetPose, simulation: Simulation) -> Pose:
    """Return the model's pose at which its link has the requested one, with unchanged joints."""
    link = _find_link(simulation, move.model, move.link)
    return _pose(move.position, move.orientation) @ link.pose.inverse() @ find_model(simulation, move.model).pose


def _pose(position: Vector3, orientation: Quaternion) -> Pose:
    """Return the pose from a position and a quaternion of any length."""
    length = math.hypot(*orientation)
    qw, qx, qy, qz = (part / length for part in orientation)
    return Pose(position, (qw, qx, qy, qz))


def _set_mass(change: SetMass, simulation: Simulation) -> None:
    link = _find_link(simulation, change.model, change.link)
    before = link.link.inertial
    scale = change.mass / before.mass if before.mass > 0.0 else 1.0
    (ixx, iyy, izz), (ixy, ixz, iyz) = before.moments, before.products
    after = replace(
        before,
        mass=change.mass,
        moments=(scale * ixx, scale * iyy, scale * izz),
        products=(scale * ixy, scale * ixz, scale * iyz),
    )
    _replace_link(simulation, change.model, replace(link.link, inertial=after))


def _set_friction(change: SetFriction, simulation: Simulation) -> None:
    link = _find_link(simulation, change.model, change.link)
    if not link.link.collisions:
        raise UsageError(f"link {link.name!r} has no collisions and so no friction")
    collisions = tuple(
        replace(collision, surface=replace(collision.surface, mu=change.mu, mu2=change.mu2))
        for collision in link.link.collisions
    )
    _replace_link(simulation, change.model, replace(link.link, collisions=collisions))


def _replace_link(simulation: Simulation, scope: str, link: Link) -> None:
    name = find_model(simulation, scope).name

    def edited(model: Model) -> Model:
        links = tuple(link if old.name == link.name else old for old in model.links)
        return replace(model, links=links) if model.name == name else model

    world = simulation.world
    simulation.edit(replace(world, models=tuple(map(edited, world.models))))


def _with_physics(world: World, change: SetPhysics) -> World:
    physics = world.physics
    gravity = physics.gravity if change.gravity is None else change.gravity
    step_s = physics.max_step_size_s if change.step is None else change.step
    wind = world.wind if change.wind is None else change.wind
    return replace(world, wind=wind, physics=replace(physics, gravity=gravity, max_step_size_s=step_s))


def _with_light_at(world: World, change: PlaceLight) -> World:
    names = [light.name for light in world.lights]
    if change.light not in names:
        raise UsageError(f"the world has no light {change.light!r}; it has: {', '.join(map(repr, names)) or 'none'}")
    pose = _pose(change.position, change.orientation)
    lights = tuple(
        replace(light, world_from_light=pose) if light.name == change.light else light for light in world.lights
    )
    return replace(world, lights=lights)


def _with_light(world: World, change: SetLight) -> World:
    names: list[str] = []

    def edited(light: Light, prefix: str = "") -> Light:
        names.append(f"{prefix}{light.name}")
        red, green, blue = change.diffuse
        lit = replace(light, diffuse=(red, green, blue, light.diffuse[3]), intensity=change.intensity)
        return lit if names[-1] == change.light else light

    def of_link(link: Link, model: Model) -> Link:
        lights = tuple(edited(light, f"{model.name}::{link.name}::") for light in link.lights)
        return replace(link, lights=lights) if lights else link

    changed = replace(
        world,
        lights=tuple(map(edited, world.lights)),
        models=tuple(
            replace(model, links=tuple(of_link(link, model) for link in model.links)) for model in world.models
        ),
    )
    if change.light not in names:
        raise UsageError(f"no light {change.light!r}; there are: {', '.join(map(repr, names)) or 'none'}")
    return changed
