"""Flattening of nested models into one model."""

from msgspec.structs import replace

from trundle.spatial import Pose

from .joint import Joint, JointAxis
from .kinematic_model import Model
from .link import Link
from .world import World

WORLD = "world"


def flattened(world: World) -> World:
    """Return the world without nested models; their links and joints become `inner::name`."""
    return replace(world, models=tuple(map(flat_model, world.models)))


def flat_model(model: Model) -> Model:
    """Return the model with the links, joints and plugins of all nested models."""
    if not model.models:
        return model
    links, joints, plugins = list(model.links), list(model.joints), list(model.plugins)
    for nested in model.models:
        inner = flat_model(nested)
        links += [_moved_link(link, inner, outer=model) for link in inner.links]
        joints += [_moved_joint(joint, inner) for joint in inner.joints]
        plugins += inner.plugins
    return replace(model, links=tuple(links), joints=tuple(joints), models=(), plugins=tuple(plugins))


def _moved_link(link: Link, inner: Model, *, outer: Model) -> Link:
    return replace(
        link,
        name=f"{inner.name}::{link.name}",
        model_from_link=inner.world_from_model @ link.model_from_link,
        initial_pose=None if link.initial_pose is None else inner.world_from_model @ link.initial_pose,
        self_collide=inner.self_collide if link.self_collide is None else link.self_collide,
        enable_wind=inner.enable_wind if link.enable_wind is None else link.enable_wind,
        fixed=link.fixed or (inner.static and not outer.static),
    )


def _moved_joint(joint: Joint, inner: Model) -> Joint:
    def named(link: str) -> str:
        return link if link == WORLD else f"{inner.name}::{link}"

    reference = joint.gearbox_reference_body
    return replace(
        joint,
        name=f"{inner.name}::{joint.name}",
        parent=named(joint.parent),
        child=named(joint.child),
        axis=_rotated_axis(joint.axis, inner.world_from_model, inner.name),
        axis2=_rotated_axis(joint.axis2, inner.world_from_model, inner.name),
        gearbox_reference_body=None if reference is None else named(reference),
    )


def _rotated_axis(axis: JointAxis | None, outer_from_inner: Pose, name: str) -> JointAxis | None:
    if axis is None:
        return None
    mimic = axis.mimic
    return replace(
        axis,
        direction=outer_from_inner.transform_vector(axis.direction),
        mimic=None if mimic is None else replace(mimic, joint=f"{name}::{mimic.joint}"),
    )
