"""JSON of a description, the output of `trundle check --json`.

Every pose is [x y z roll pitch yaw] in its own model's frame [m, rad]; an infinite limit is null; values are those of
the file after resolution, before physics corrects any.
"""

import math
from collections.abc import Iterator

from trundle.robots.description import LoadedDescription
from trundle.robots.model import Frame, Joint, JointAxis, JointType, Link, Mimic, Model, World, model_from_joint
from trundle.robots.robot import Robot, root_from_links

_WITHOUT_AXIS = frozenset({JointType.FIXED, JointType.BALL})
_NO_AXIS: dict[str, object] = {"axis": None, "lower": None, "upper": None, "effort": None, "velocity": None}


def description_json(loaded: LoadedDescription) -> dict[str, object]:
    """Return the JSON of a world, a model or a URDF."""
    world = loaded.world
    result: dict[str, object] = {
        "kind": "world" if loaded.kind == "world" else "model",
        "name": world.name,
        "sdf_version": world.sdf_version,
        "models": [_model(model) for model in world.models],
    }
    if loaded.kind == "world":
        result |= _world(world)
    if loaded.robot is not None:
        result["urdf"] = _urdf(loaded.robot)
    return result


def _model(model: Model) -> dict[str, object]:
    return {
        "name": model.name,
        "pose": model.world_from_model.as_list(),
        "static": model.static,
        "self_collide": model.self_collide,
        "canonical_link": model.canonical_link,
        "links": [_link(link) for link in model.links],
        "joints": [_joint(model, joint) | {"name": name} for joint, name in _named_joints(model)],
        "frames": [_frame(frame) for frame in model.frames],
        "models": [_model(nested) for nested in model.models],
        "plugins": [{"name": plugin.name, "filename": plugin.filename} for plugin in model.plugins],
    }


def _named_joints(model: Model) -> Iterator[tuple[Joint, str]]:
    """Yield joints with unique names: one named like a link, as SDF before 1.7 allows, gets the suffix `_joint`."""
    link_names = {link.name for link in model.links}
    for joint in model.joints:
        yield joint, f"{joint.name}_joint" if joint.name in link_names else joint.name


def _link(link: Link) -> dict[str, object]:
    inertial = link.inertial
    return {
        "name": link.name,
        "mass": inertial.mass,
        "inertia": [*inertial.moments, *inertial.products],
        "inertial_pose": inertial.link_from_com.as_list(),
        "pose": link.model_from_link.as_list(),
        "visuals": len(link.visuals),
        "collisions": len(link.collisions),
        "sensors": [sensor.name for sensor in link.sensors],
    }


def _joint(model: Model, joint: Joint) -> dict[str, object]:
    axis2 = _axis(joint.axis2)
    return {
        "name": joint.name,
        "type": joint.type.value,
        "parent": joint.parent_frame or joint.parent,
        "child": joint.child_frame or joint.child,
        "pose": model_from_joint(model, joint).as_list(),
        **(_NO_AXIS if joint.type in _WITHOUT_AXIS else _axis(joint.axis)),
        "axis2": axis2["axis"],
        "lower2": axis2["lower"],
        "upper2": axis2["upper"],
        "damping": 0.0 if joint.axis is None else joint.axis.damping,
        "friction": 0.0 if joint.axis is None else joint.axis.friction,
        "spring_reference": 0.0 if joint.axis is None else joint.axis.spring_reference,
        "spring_stiffness": 0.0 if joint.axis is None else joint.axis.spring_stiffness,
        "thread_pitch": joint.thread_pitch if joint.type is JointType.SCREW else None,
        "mimic": None if joint.axis is None else _mimic(joint.axis.mimic),
    }


def _mimic(mimic: Mimic | None) -> dict[str, object] | None:
    if mimic is None:
        return None
    return {
        "joint": mimic.joint,
        "axis": "axis2" if mimic.axis else "axis",
        "multiplier": mimic.multiplier,
        "offset": mimic.offset,
        "reference": mimic.reference,
    }


def _frame(frame: Frame) -> dict[str, object]:
    return {"name": frame.name, "attached_to": frame.attached_to, "pose": frame.model_from_frame.as_list()}


def _axis(axis: JointAxis | None) -> dict[str, object]:
    if axis is None:
        return _NO_AXIS
    return {
        "axis": list(axis.direction),
        "lower": _finite(axis.lower),
        "upper": _finite(axis.upper),
        "effort": _finite(axis.effort),
        "velocity": _finite(axis.velocity),
    }


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _world(world: World) -> dict[str, object]:
    return {
        "joints": [_joint(_world_model(world), joint) for joint in world.joints],
        "frames": [_frame(frame) for frame in world.frames],
        "lights": [
            {
                "name": light.name,
                "type": light.type,
                "pose": light.world_from_light.as_list(),
                "direction": list(light.direction),
                "diffuse": list(light.diffuse),
                "specular": list(light.specular),
            }
            for light in world.lights
        ],
        "gravity": list(world.physics.gravity),
        "physics": {
            "max_step_size": world.physics.max_step_size_s,
            "real_time_update_rate": world.physics.real_time_update_rate_hz,
        },
    }


def _world_model(world: World) -> Model:
    """Return the world as a model, for joints between its models."""
    return Model(name=world.name, at=world.at, models=world.models)


def _urdf(robot: Robot) -> dict[str, object]:
    poses = root_from_links(robot, {joint.name: 0.0 for joint in robot.joints})
    return {
        "name": robot.name,
        "root": robot.root,
        "links": [{"name": link.name, "pose": poses[link.name].as_list()} for link in robot.links],
        "joints": [
            {"name": joint.name, "type": joint.type, "parent": joint.parent, "child": joint.child}
            for joint in robot.joints
        ],
    }
