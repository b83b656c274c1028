"""Applies <state>: where models were when a world was saved, which is where Gazebo puts them at load."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

from trundle.model import Light, Model
from trundle.spatial import Pose
from trundle.xmlnode import XmlNode

from .context import Context, read_pose

_MOVED_M = 1e-3
"""A link less than this from where its model has it was saved as it was written."""


def apply_state(
    world: XmlNode, name: str, models: Sequence[Model], lights: Sequence[Light], context: Context
) -> tuple[tuple[Model, ...], tuple[Light, ...]]:
    """The models and lights where the world's <state> has them, without those it deletes."""
    for node in world.all("state"):
        if (node.attribute("world_name") or name) != name:
            context.report.warn(node.at, f"<state> of world {node.attribute('world_name')!r}; this is {name!r}")
        models, lights = _applied(node, models, lights, context)
    return tuple(models), tuple(lights)


def _applied(
    node: XmlNode, models: Sequence[Model], lights: Sequence[Light], context: Context
) -> tuple[Sequence[Model], Sequence[Light]]:
    report = context.report
    poses = {state.attribute("name"): state for state in _model_states(node)}
    lit = {state.attribute("name"): state for tag in ("light", "light_state") for state in node.all(tag)}
    deletions = node.find("deletions")
    gone = {child.text for child in deletions.all("name")} if deletions is not None else set[str]()
    for tag in ("sim_time", "wall_time", "real_time", "iterations", "time", "joint_state"):
        node.find(tag)
    insertions = node.find("insertions")
    if insertions is not None and insertions.children:
        report.warn(insertions.at, "<insertions> of a <state> are not supported; what was added later is left out")
    node.report_unread(report)
    there = {model.name for model in models}
    for name, state in poses.items():
        if name not in there:
            report.warn(state.at, f"<state> of model {name!r}, which is not in this world; it is ignored")
    placed = [
        _placed(model, poses[model.name], Pose(), context) if model.name in poses else model
        for model in models
        if model.name not in gone
    ]
    shone = [
        replace(light, world_from_light=read_pose(lit[light.name], context).pose)
        if light.name in lit and lit[light.name].find("pose") is not None
        else light
        for light in lights
        if light.name not in gone
    ]
    return placed, shone


def _placed(model: Model, state: XmlNode, world_from_outer: Pose, context: Context) -> Model:
    """A model where its state has it; states of nested models are in the world too."""
    if state.find("pose") is None:
        return model
    world_from_model = read_pose(state, context).pose
    nested = {inner.attribute("name"): inner for inner in _model_states(state)}
    scale = state.vector("scale", default=(1.0, 1.0, 1.0), report=context.report)
    if scale != (1.0, 1.0, 1.0):
        context.report.warn(
            state.at, f"<state> of model {model.name!r}: <scale> is not supported; the size is as written"
        )
    moved = [link for link in _link_states(state) if _has_moved(model, link, world_from_model, context)]
    if moved:
        names = ", ".join(repr(link.attribute("name")) for link in moved[:5])
        context.report.info(
            moved[0].at,
            f"<state> of model {model.name!r}: links saved elsewhere than written ({names}) start as written",
        )
    return replace(
        model,
        world_from_model=world_from_outer.inverse() @ world_from_model,
        models=tuple(
            _placed(inner, nested[inner.name], world_from_model, context) if inner.name in nested else inner
            for inner in model.models
        ),
    )


def _has_moved(model: Model, state: XmlNode, world_from_model: Pose, context: Context) -> bool:
    link = next((link for link in model.links if link.name == state.attribute("name")), None)
    if link is None or state.find("pose") is None:
        return False
    saved = world_from_model.inverse() @ read_pose(state, context).pose
    return any(abs(a - b) > _MOVED_M for a, b in zip(saved.position, link.model_from_link.position, strict=True))


def _model_states(node: XmlNode) -> Iterator[XmlNode]:
    for tag in ("model", "model_state"):
        yield from node.all(tag)


def _link_states(node: XmlNode) -> Iterator[XmlNode]:
    for tag in ("link", "link_state"):
        yield from node.all(tag)
