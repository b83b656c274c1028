"""The scene as moveit_msgs/PlanningScene: all of it, or what changed."""

from typing import TYPE_CHECKING, Any

import numpy as np

from .scene_contents import SceneContents
from .state_messages import state_fields

if TYPE_CHECKING:
    from trundle.planning.robot_model import RobotModel

SCENE_SETTINGS, ROBOT_STATE, ROBOT_STATE_ATTACHED_OBJECTS = 1, 2, 4
WORLD_OBJECT_NAMES, WORLD_OBJECT_GEOMETRY, OCTOMAP = 8, 16, 32
TRANSFORMS, ALLOWED_COLLISION_MATRIX, LINK_PADDING_AND_SCALING, OBJECT_COLORS = 64, 128, 256, 512
"""Bits of moveit_msgs/PlanningSceneComponents."""
ALL = 1023
_REMOVE = 1


def scene_fields(
    model: "RobotModel", contents: SceneContents, positions: np.ndarray, *, stamp_ns: int, components: int = ALL
) -> dict[str, Any]:
    """Return the fields of a scene with the components asked for."""
    frame = model.model_frame
    fields: dict[str, Any] = {"is_diff": components != ALL, "robot_model_name": model.name}
    if components & SCENE_SETTINGS:
        fields["name"] = contents.name
    if components & TRANSFORMS:
        identity = {"rotation": {"w": 1.0}}
        header = {"frame_id": frame, "stamp": stamp_ns}
        fields["fixed_frame_transforms"] = [{"header": header, "child_frame_id": frame, "transform": identity}]
    if components & (ROBOT_STATE | ROBOT_STATE_ATTACHED_OBJECTS):
        carried = contents.carried if components & ROBOT_STATE_ATTACHED_OBJECTS else None
        fields["robot_state"] = state_fields(model, positions, stamp_ns=stamp_ns, carried=carried)
        if carried is None:
            fields["robot_state"]["is_diff"] = True
    if components & ALLOWED_COLLISION_MATRIX:
        fields["allowed_collision_matrix"] = _matrix(contents)
    if components & LINK_PADDING_AND_SCALING:
        fields |= _paddings(contents)
    if components & OBJECT_COLORS:
        fields["object_colors"] = _colors(contents)
    world: dict[str, Any] = {}
    if components & WORLD_OBJECT_GEOMETRY:
        world["collision_objects"] = [item.fields(frame) for item in contents.objects.values()]
    elif components & WORLD_OBJECT_NAMES:
        world["collision_objects"] = [
            {"id": item.id, "type": {"key": item.type_key, "db": item.type_db}} for item in contents.objects.values()
        ]
    if components & OCTOMAP and contents.octomap is not None:
        world["octomap"] = contents.octomap
    if world:
        fields["world"] = world
    return fields


def diff_fields(
    model: "RobotModel", old: SceneContents, new: SceneContents, positions: np.ndarray, *, stamp_ns: int
) -> dict[str, Any]:
    """Return the fields of a diff that makes a scene of another."""
    frame = model.model_frame
    state = state_fields(model, positions, stamp_ns=stamp_ns, is_diff=True)
    state["attached_collision_objects"] = [
        item.fields() for name, item in new.carried.items() if old.carried.get(name) is not item
    ] + [
        {"link_name": item.link, "object": {"id": name, "operation": _REMOVE}}
        for name, item in old.carried.items()
        if name not in new.carried
    ]
    changed = [item.fields(frame) for name, item in new.objects.items() if old.objects.get(name) is not item]
    gone = [name for name in (*old.objects, *old.carried) if name not in new.objects and name not in new.carried]
    removed = [{"id": name, "operation": _REMOVE, "header": {"frame_id": frame}} for name in dict.fromkeys(gone)]
    world: dict[str, Any] = {"collision_objects": [*removed, *changed]}
    if new.octomap is not None and new.octomap is not old.octomap:
        world["octomap"] = new.octomap
    fields: dict[str, Any] = {
        "name": new.name,
        "robot_model_name": model.name,
        "is_diff": True,
        "robot_state": state,
        "world": world,
    }
    if new.allowed != old.allowed:
        fields["allowed_collision_matrix"] = _matrix(new)
    if (new.padding, new.scale) != (old.padding, old.scale):
        fields |= _paddings(new)
    if new.colors != old.colors:
        fields["object_colors"] = _colors(new)
    return fields


def _matrix(contents: SceneContents) -> dict[str, Any]:
    allowed = contents.allowed
    defaults = allowed.defaults
    return {
        "entry_names": allowed.names,
        "entry_values": [{"enabled": row} for row in allowed.rows()],
        "default_entry_names": list(defaults),
        "default_entry_values": list(defaults.values()),
    }


def _paddings(contents: SceneContents) -> dict[str, Any]:
    return {
        "link_padding": [{"link_name": name, "padding": value} for name, value in contents.padding.items()],
        "link_scale": [{"link_name": name, "scale": value} for name, value in contents.scale.items()],
    }


def _colors(contents: SceneContents) -> list[dict[str, Any]]:
    return [{"id": name, "color": {"r": r, "g": g, "b": b, "a": a}} for name, (r, g, b, a) in contents.colors.items()]
