"""Manifest of a simulated world for the page: docs/protocol.md."""

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence

import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray

from trundle.base.diagnostics import Source
from trundle.base.xmlnode import XmlNode
from trundle.robots.model import Collision, Joint, Light, Link, Model, PluginTag, Sensor, World
from trundle.ros.bridge import link_frames, sensor_topic
from trundle.sim.sensors import CameraSensor, InstrumentSensor
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose, rpy_from_quaternion

from ..scene_settings import scene_settings
from ..world.manifest import (
    CameraInfo,
    FrameInfo,
    JointInfo,
    LightInfo,
    LinkInfo,
    Manifest,
    ModelInfo,
    PhysicsSettings,
    PluginInfo,
    PoseNumbers,
    SensorInfo,
)
from .body_numbers import BodyNumbers
from .handling import is_held
from .sensor_series import SENSOR_VALUES

_IMAGE = "sensor_msgs/Image"


def world_manifest(
    simulation: Simulation, sensors: Sequence[CameraSensor | InstrumentSensor], bodies: BodyNumbers
) -> Manifest:
    """Return the manifest without its generation and files.

    Args:
        simulation: running simulation.
        sensors: running sensors.
        bodies: body numbers of the links.
    """
    world = simulation.world
    live = {(sensor.model.name, sensor.link.name, sensor.sensor.name): sensor for sensor in sensors}
    indices = joint_rows(simulation)
    lights_of_links = (
        _light(light, f"{model.name}::{link.name}::", bodies[f"{model.name}::{link.name}"])
        for model in world.models
        for link in model.links
        for light in link.lights
    )
    frames = zip(link_frames(world), simulation.engine.compiled.link_names, strict=True)
    return Manifest(
        name=world.name,
        scene=scene_settings(world),
        physics=PhysicsSettings(gravity=world.physics.gravity, wind=world.wind, step=world.physics.max_step_size_s),
        robot=_robot(world, bodies),
        models=tuple(
            _nested(_model(model, bodies, live, indices, held=is_held(simulation, model.name)))
            for model in world.models
        ),
        plugins=_plugins(world.plugins),
        lights=(*(_light(light, "", None) for light in world.lights), *lights_of_links),
        cameras=tuple(_camera(sensor, bodies) for sensor in sensors if isinstance(sensor, CameraSensor)),
        frames=tuple(FrameInfo(frame=link.frame, parent=link.parent, body=bodies[name]) for link, name in frames),
    )


def joint_rows(simulation: Simulation) -> dict[str, int]:
    """Return the row of each joint with a single axis, `model::joint`, in `trundle/joints`."""
    compiled = simulation.engine.compiled
    single = [name for name, axes in zip(compiled.joint_names, compiled.joint_axes, strict=True) if len(axes) == 1]
    return {name: row for row, name in enumerate(single)}


def single_axes(simulation: Simulation) -> NDArray[np.intp]:
    """Return the index in a snapshot of each joint with a single axis."""
    joints = enumerate(simulation.engine.compiled.joint_axes)
    return np.array([index for index, axes in joints if len(axes) == 1], dtype=np.intp)


def camera_topic(camera: CameraSensor) -> str:
    """Return the topic of a camera's pictures; without ROS, the topic that the camera would publish."""
    published = (topic for topic, message in camera.topics.items() if message == _IMAGE)
    part = camera.optics.name
    default = sensor_topic(camera.model, camera.link.name, camera.sensor, "image_raw", main="image_raw", part=part)
    return next(published, default)


def find_robot(world: World) -> Model | None:
    """Return the first of the non-static models with the most joints; None if all are static."""
    return max((m for m in world.models if not m.static and m.links), key=lambda m: len(m.joints), default=None)


def _robot(world: World, bodies: BodyNumbers) -> int | None:
    robot = find_robot(world)
    return None if robot is None else bodies[f"{robot.name}::{robot.links[0].name}"]


_Live = Mapping[tuple[str, str, str], CameraSensor | InstrumentSensor]


def _model(model: Model, bodies: BodyNumbers, live: _Live, indices: Mapping[str, int], *, held: bool) -> ModelInfo:
    return ModelInfo(
        name=model.name,
        static=model.static,
        held=held,
        source=_source(model.at),
        links=tuple(_link(model, link, bodies, live) for link in model.links),
        joints=tuple(_joint(joint, model, indices.get(f"{model.name}::{joint.name}")) for joint in model.joints),
        plugins=_plugins(model.plugins),
    )


def _nested(flat: ModelInfo) -> ModelInfo:
    """Return a model whose links and joints named `inner::name` are moved into nested models, as in the file."""
    links: dict[str | None, list[LinkInfo]] = {}
    joints: dict[str | None, list[JointInfo]] = {}
    for link in flat.links:
        scope, name = _scoped(link.name)
        links.setdefault(scope, []).append(replace(link, name=name))
    for joint in flat.joints:
        scope, name = _scoped(joint.name)
        parent, child = (end.removeprefix(f"{scope}::") for end in (joint.parent, joint.child))
        joints.setdefault(scope, []).append(replace(joint, name=name, parent=parent, child=child))
    outer = replace(flat, links=tuple(links.pop(None, ())), joints=tuple(joints.pop(None, ())))
    inner = (
        ModelInfo(
            name=scope,
            static=flat.static,
            source=None,
            links=tuple(links.get(scope, ())),
            joints=tuple(joints.get(scope, ())),
        )
        for scope in dict.fromkeys((*links, *joints))
        if scope is not None
    )
    return replace(outer, models=tuple(map(_nested, inner)))


def _scoped(name: str) -> tuple[str | None, str]:
    """Return the outermost model in a name, and the rest of the name."""
    scope, separator, inner = name.partition("::")
    return (scope, inner) if separator else (None, name)


def _link(model: Model, link: Link, bodies: BodyNumbers, live: _Live) -> LinkInfo:
    inertial = link.inertial
    on_joints = (sensor for joint in model.joints if joint.child == link.name for sensor in joint.sensors)
    return LinkInfo(
        name=link.name,
        body=bodies[f"{model.name}::{link.name}"],
        mass=inertial.mass,
        inertia=(*inertial.moments, *inertial.products),
        inertial_pose=_six(inertial.link_from_com),
        friction=_friction(link.collisions),
        source=_source(link.at),
        sensors=tuple(
            _sensor(sensor, live.get((model.name, link.name, sensor.name))) for sensor in (*link.sensors, *on_joints)
        ),
    )


def _sensor(sensor: Sensor, live: CameraSensor | InstrumentSensor | None) -> SensorInfo:
    if isinstance(live, CameraSensor):
        topic = camera_topic(live)
    else:
        topic = None if live is None else next(iter(live.topics), None)
    return SensorInfo(
        name=sensor.name,
        type=sensor.type,
        rate=sensor.update_rate_hz if live is None else live.rate_hz,
        topic=topic,
        series=tuple(SENSOR_VALUES.get(sensor.type, ())),
        source=_source(sensor.at),
        plugins=_plugins(sensor.plugins),
    )


def _plugins(tags: Iterable[PluginTag]) -> tuple[PluginInfo, ...]:
    """Return plugins under unique names: the second `drive` is `drive (2)`."""
    counts = Counter[str]()
    plugins: list[PluginInfo] = []
    for tag in tags:
        counts[tag.name] += 1
        plugins.append(
            PluginInfo(
                name=tag.name if counts[tag.name] == 1 else f"{tag.name} ({counts[tag.name]})",
                filename=tag.filename,
                source=_source(tag.at),
                parameters=tuple(_parameters(tag.node)),
            )
        )
    return tuple(plugins)


def _parameters(node: XmlNode, path: str = "") -> Iterator[tuple[str, str]]:
    """Yield path (`noise/stddev`) and text of each element in a plugin that has text or no children."""
    for child in node.children:
        name = f"{path}{child.tag}"
        if child.text or not child.children:
            yield name, child.text
        yield from _parameters(child, f"{name}/")


def _friction(collisions: Iterable[Collision]) -> tuple[float, float] | None:
    first = next(iter(collisions), None)
    return None if first is None else (first.surface.mu, first.surface.mu2)


def _joint(joint: Joint, model: Model, index: int | None) -> JointInfo:
    axis = joint.axis
    child = next((link.model_from_link for link in model.links if link.name == joint.child), Pose())
    axes = (used for used in (axis, joint.axis2) if used is not None)
    return JointInfo(
        name=joint.name,
        type=joint.type.value,
        parent=joint.parent,
        child=joint.child,
        lower=axis.lower if axis is not None and math.isfinite(axis.lower) else None,
        upper=axis.upper if axis is not None and math.isfinite(axis.upper) else None,
        pose=_six(joint.child_from_joint),
        axes=tuple(child.inverse().transform_vector(used.direction) for used in axes),
        index=index,
        source=_source(joint.at),
    )


def _light(light: Light, prefix: str, body: int | None) -> LightInfo:
    return LightInfo(
        name=f"{prefix}{light.name}",
        type=light.type,
        body=body,
        pose=_six(light.world_from_light),
        direction=light.direction,
        diffuse=light.diffuse[:3],
        intensity=light.intensity,
    )


def _camera(camera: CameraSensor, bodies: BodyNumbers) -> CameraInfo:
    lens = camera.intrinsics
    return CameraInfo(
        name=camera.name,
        topic=camera_topic(camera),
        body=bodies[f"{camera.model.name}::{camera.link.name}"],
        pose=_six(camera.link_from_camera),
        horizontal_fov=lens.horizontal_fov_rad,
        width=lens.width_px,
        height=lens.height_px,
        near=camera.optics.near_m,
        far=camera.optics.far_m,
        rate=camera.rate_hz,
    )


def _six(pose: Pose) -> PoseNumbers:
    return (*pose.position, *rpy_from_quaternion(pose.quaternion))


def _source(at: Source) -> str | None:
    return None if at.line is None else str(at)
