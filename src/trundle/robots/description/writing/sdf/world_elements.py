"""Writer of <road>, <actor> and <state>."""

from trundle.robots.model import Actor, Model, Road, World
from trundle.spatial import Pose

from ..files import UriOf
from ..tag import Tag
from .shapes import add_material


def add_road(home: Tag, road: Road, uri_of: UriOf) -> None:
    """Append <road>."""
    tag = home.add("road", name=road.name)
    tag.add("width", road.width)
    for point in road.points:
        tag.add("point", point)
    add_material(tag, road.material, uri_of)


def add_actor(home: Tag, actor: Actor, uri_of: UriOf) -> Tag:
    """Append <actor> without its links, joints and plugins, and return it."""
    tag = home.add("actor", name=actor.name)
    tag.add_pose(actor.world_from_actor)
    if actor.skin is not None:
        skin = tag.add("skin")
        skin.add("filename", uri_of(actor.skin.path, actor.skin.uri))
        skin.add("scale", actor.skin.scale)
    for animation in actor.animations:
        animation_tag = tag.add("animation", name=animation.name)
        animation_tag.add("filename", uri_of(animation.path, animation.uri))
        animation_tag.add("scale", animation.scale)
        animation_tag.add("interpolate_x", animation.interpolate_x)
    script = tag.add("script")
    script.add("loop", actor.loop)
    script.add("delay_start", actor.delay_start_s)
    script.add("auto_start", actor.auto_start)
    for trajectory in actor.trajectories:
        trajectory_tag = script.add(
            "trajectory", id=str(trajectory.id), type=trajectory.type, tension=repr(trajectory.tension)
        )
        for point in trajectory.waypoints:
            waypoint = trajectory_tag.add("waypoint")
            waypoint.add("time", point.time_s)
            waypoint.add_pose(point.pose)
    return tag


def add_state(home: Tag, world: World) -> None:
    """Append <state>, if any link has an initial pose."""
    started = [model for model in world.models if _starts_elsewhere(model)]
    if started:
        state = home.add("state", world_name=world.name)
        for model in started:
            _add_model_state(state, model, Pose())


def _starts_elsewhere(model: Model) -> bool:
    return any(link.initial_pose is not None for link in model.links) or any(map(_starts_elsewhere, model.models))


def _add_model_state(home: Tag, model: Model, world_from_outer: Pose) -> None:
    world_from_model = world_from_outer @ model.world_from_model
    tag = home.add("model", name=model.name)
    tag.add("pose", world_from_model.as_list())
    for link in model.links:
        if link.initial_pose is not None:
            tag.add("link", name=link.name).add("pose", (world_from_model @ link.initial_pose).as_list())
    for nested in model.models:
        if _starts_elsewhere(nested):
            _add_model_state(tag, nested, world_from_model)
