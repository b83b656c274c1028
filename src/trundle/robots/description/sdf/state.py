"""Reader of <state>: saved poses, which Gazebo applies at load."""

from collections.abc import Iterator, Sequence

from msgspec.structs import replace

from trundle.base.xmlnode import XmlNode
from trundle.robots.model import Light, Link, Model
from trundle.spatial import Pose

from .context import Context, read_pose, warn_ignored
from .scale import scaled_model

_POSE_TOLERANCE = 1e-3
"""Difference in position [m] or quaternion below which a link's saved pose counts as unchanged."""
_AT_REST = ("velocity", "acceleration", "wrench", "linear_velocity", "angular_velocity")
_ACCELERATED = ("linear_acceleration", "angular_acceleration", "force", "torque")


def inserted(world: XmlNode) -> Iterator[XmlNode]:
    """Yield the elements of models and lights inserted after the world was loaded, in order."""
    for state in world.all("state"):
        insertions = state.find("insertions")
        for child in [] if insertions is None else insertions.children:
            if child.tag in ("model", "light"):
                yield child


def apply_state(
    world: XmlNode, name: str, models: Sequence[Model], lights: Sequence[Light], context: Context
) -> tuple[tuple[Model, ...], tuple[Light, ...]]:
    """Return the models and lights at the poses of the world's <state>, without the deleted ones."""
    for node in world.all("state"):
        if (node.attribute("world_name") or name) != name:
            context.report.warn(
                node.at, f"<state> of world {node.attribute('world_name')!r}; this is {name!r}", "state-target"
            )
        models, lights = _applied(node, models, lights, context)
    return tuple(models), tuple(lights)


def _applied(
    node: XmlNode, models: Sequence[Model], lights: Sequence[Light], context: Context
) -> tuple[Sequence[Model], Sequence[Light]]:
    report = context.report
    model_states = {state.attribute("name"): state for state in _states(node, "model")}
    light_states = {state.attribute("name"): state for state in _states(node, "light")}
    deleted = _deleted(node, {part.name for part in (*models, *lights)}, context)
    warn_ignored(
        node, ("sim_time", "wall_time", "real_time", "iterations", "time"), "has no effect: time starts at 0", context
    )
    warn_ignored(node, ("joint_state",), "has no effect: joints start at the poses of their links", context)
    insertions = node.find("insertions")
    if insertions is not None:
        insertions.all("model")
        insertions.all("light")
        insertions.report_unread(report)
    node.report_unread(report)
    for kind, states, parts in (("model", model_states, models), ("light", light_states, lights)):
        for name, state in states.items():
            if name not in {part.name for part in parts}:
                report.warn(state.at, f"<state> of unknown {kind} {name!r}; it is ignored", "state-target")
                state.mark_all_read()
    placed_models = [
        _model_with_state(model, model_states[model.name], Pose(), context) if model.name in model_states else model
        for model in models
        if model.name not in deleted
    ]
    placed_lights = [
        _light_with_state(light, light_states.get(light.name), context) for light in lights if light.name not in deleted
    ]
    return placed_models, placed_lights


def _deleted(node: XmlNode, existing: set[str], context: Context) -> set[str]:
    deletions = node.find("deletions")
    if deletions is None:
        return set()
    names = deletions.all("name")
    for name in names:
        if name.text not in existing:
            context.report.warn(
                name.at, f"<deletions> of a <state>: no model or light {name.text!r} in this world", "state-target"
            )
    deletions.report_unread(context.report)
    return {name.text for name in names}


def _light_with_state(light: Light, state: XmlNode | None, context: Context) -> Light:
    if state is None:
        return light
    pose = state.find("pose")
    state.report_unread(context.report)
    return light if pose is None else replace(light, world_from_light=read_pose(state, context).pose)


def _model_with_state(model: Model, state: XmlNode, world_from_outer: Pose, context: Context) -> Model:
    """Return a model at its saved pose; saved poses of nested models are in the world frame too."""
    report = context.report
    has_pose = state.find("pose") is not None
    nested = {inner.attribute("name"): inner for inner in _states(state, "model")}
    links = {link.attribute("name"): link for link in _states(state, "link")}
    scale = state.vector("scale", default=(1.0, 1.0, 1.0))
    warn_ignored(state, ("joint", "joint_state"), "has no effect, as in Gazebo: the poses of links apply", context)
    state.report_unread(report)
    for name, link_state in links.items():
        if name not in {link.name for link in model.links}:
            report.warn(
                link_state.at, f"<state> of model {model.name!r}: no link {name!r}; it is ignored", "state-target"
            )
    if scale != (1.0, 1.0, 1.0):
        model = scaled_model(model, scale, state.at, report)
    world_from_model = read_pose(state, context).pose if has_pose else world_from_outer @ model.world_from_model
    joined = set[str]() if model.static else {end for joint in model.joints for end in (joint.parent, joint.child)}
    placed_links = tuple(
        _link_with_state(link, links[link.name], world_from_model, context, is_joined=link.name in joined)
        if link.name in links
        else link
        for link in model.links
    )
    return replace(
        model,
        world_from_model=world_from_outer.inverse() @ world_from_model,
        links=placed_links,
        models=tuple(
            _model_with_state(inner, nested[inner.name], world_from_model, context) if inner.name in nested else inner
            for inner in model.models
        ),
    )


def _link_with_state(link: Link, state: XmlNode, world_from_model: Pose, context: Context, *, is_joined: bool) -> Link:
    """Return a link at its saved pose, which for a link with a joint is the initial pose: the joint's zero stays."""
    warn_ignored(state, _AT_REST + _ACCELERATED, "has no effect: everything starts at rest", context)
    warn_ignored(state, ("collision", "collision_state"), "has no effect, as in Gazebo", context)
    has_pose = state.find("pose") is not None
    state.report_unread(context.report)
    if not has_pose:
        return link
    model_from_link = world_from_model.inverse() @ read_pose(state, context).pose
    written_from_saved = link.model_from_link.inverse() @ model_from_link
    moved = max(map(abs, (*written_from_saved.position, *written_from_saved.quaternion[1:])))
    if moved <= _POSE_TOLERANCE:
        return link
    return replace(link, initial_pose=model_from_link) if is_joined else replace(link, model_from_link=model_from_link)


def _states(node: XmlNode, kind: str) -> Iterator[XmlNode]:
    """Yield states of models, links or lights, which SDF 1.12 calls `…_state`."""
    for tag in (kind, f"{kind}_state"):
        yield from node.all(tag)
