"""World as it is at this moment, for a file: what was changed while it ran, at the poses of now."""

from msgspec.structs import replace

from trundle.robots.model import Link, Model, World
from trundle.sim.simulation import ModelHandle, Simulation
from trundle.spatial import Pose

_MOVED = 1e-3
"""Deviation [m, and of a unit quaternion] below which a link counts as where it is written, as in a saved state."""


def current_world(simulation: Simulation) -> World:
    """Return the world with current poses, without the models that stand for actors."""
    models = tuple(_at_rest(handle) for handle in simulation.models if handle.name not in simulation.actors)
    return replace(simulation.world, models=models)


def _at_rest(handle: ModelHandle) -> Model:
    """Return a model at its pose, with links where they are."""
    model, pose = handle.model, handle.pose
    joined = set[str]() if model.static else {end for joint in model.joints for end in (joint.parent, joint.child)}
    links = tuple(
        _posed(link.link, pose.inverse() @ link.pose, is_joined=link.link.name in joined) for link in handle.links
    )
    return replace(model, world_from_model=pose, links=links)


def _posed(link: Link, model_from_link: Pose, *, is_joined: bool) -> Link:
    """Return a link at a pose; for a link with a joint it is the initial one, and the joint's zero is kept."""
    moved = link.model_from_link.inverse() @ model_from_link
    if max(map(abs, (*moved.position, *moved.quaternion[1:]))) <= _MOVED:
        return replace(link, initial_pose=None)
    return replace(link, initial_pose=model_from_link) if is_joined else replace(link, model_from_link=model_from_link)
