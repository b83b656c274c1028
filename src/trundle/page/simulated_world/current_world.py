"""World in its current state, to be saved: with the edits made while it ran, at current poses."""

from msgspec.structs import replace

from trundle.robots.model import Link, Model, World
from trundle.sim.simulation import ModelHandle, Simulation
from trundle.spatial import Pose

_POSE_TOLERANCE = 1e-3
"""Deviation [m, and of a unit quaternion] up to which a link keeps its pose as written, as in a saved state."""


def current_world(simulation: Simulation) -> World:
    """Return the world with current poses, without the models that represent actors."""
    models = tuple(_at_current_poses(handle) for handle in simulation.models if handle.name not in simulation.actors)
    return replace(simulation.world, models=models)


def _at_current_poses(handle: ModelHandle) -> Model:
    """Return a model with the current poses of itself and its links."""
    model, pose = handle.model, handle.pose
    joined = set[str]() if model.static else {end for joint in model.joints for end in (joint.parent, joint.child)}
    links = tuple(
        _at_pose(link.link, pose.inverse() @ link.pose, is_joined=link.link.name in joined) for link in handle.links
    )
    return replace(model, world_from_model=pose, links=links)


def _at_pose(link: Link, model_from_link: Pose, *, is_joined: bool) -> Link:
    """Return a link at a pose; with a joint, only its initial pose changes, so that the joint keeps its zero."""
    moved = link.model_from_link.inverse() @ model_from_link
    if max(map(abs, (*moved.position, *moved.quaternion[1:]))) <= _POSE_TOLERANCE:
        return replace(link, initial_pose=None)
    return replace(link, initial_pose=model_from_link) if is_joined else replace(link, model_from_link=model_from_link)
