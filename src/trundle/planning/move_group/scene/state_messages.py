"""States of the robot as moveit_msgs/RobotState."""

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from trundle.spatial import Pose

from .shapes import pose_fields

if TYPE_CHECKING:
    from trundle.planning.robot_model import RobotModel
    from trundle.ros import Message

    from .scene_contents import CarriedObject


def state_fields(
    model: "RobotModel",
    positions: np.ndarray,
    *,
    stamp_ns: int = 0,
    carried: "Mapping[str, CarriedObject] | None" = None,
    velocities: np.ndarray | None = None,
    is_diff: bool = False,
) -> dict[str, Any]:
    """Return the fields of a moveit_msgs/RobotState.

    Args:
        model: robot.
        positions: state vector.
        stamp_ns: time.
        carried: attached objects; None: none are given.
        velocities: of each variable; None: none are given.
        is_diff: True: what is not given stays.
    """
    single = [joint for joint in model.joints if len(joint.variables) == 1]
    multiple = [joint for joint in model.joints if len(joint.variables) > 1]
    indices = [model.variable_index(joint.name) for joint in single]
    header = {"frame_id": model.model_frame, "stamp": stamp_ns}
    joint_state: dict[str, Any] = {
        "header": header,
        "name": [joint.name for joint in single],
        "position": [float(positions[index]) for index in indices],
    }
    if velocities is not None:
        joint_state["velocity"] = [float(velocities[index]) for index in indices]
    fields: dict[str, Any] = {
        "joint_state": joint_state,
        "multi_dof_joint_state": {
            "header": header,
            "joint_names": [joint.name for joint in multiple],
            "transforms": [
                transform_fields([float(positions[model.variable_index(v)]) for v in j.variables]) for j in multiple
            ],
        },
        "is_diff": is_diff,
    }
    if carried is not None:
        fields["attached_collision_objects"] = [item.fields() for item in carried.values()]
    return fields


def transform_fields(values: list[float]) -> dict[str, Any]:
    """Return the fields of a geometry_msgs/Transform of a planar joint's three variables, or a floating one's seven."""
    if len(values) == 3:
        pose = Pose.from_rpy(values[0], values[1], 0.0, 0.0, 0.0, values[2])
    else:
        x, y, z, qx, qy, qz, qw = values
        pose = Pose((x, y, z), (qw, qx, qy, qz))
    fields = pose_fields(pose)
    return {"translation": fields["position"], "rotation": fields["orientation"]}


def positions_of(model: "RobotModel", message: "Message", base: np.ndarray) -> np.ndarray:
    """Return a state vector changed by a moveit_msgs/RobotState; unknown joints are left out.

    Raises:
        ValueError: names and positions differ in number, or a position is not finite.
    """
    values = np.array(base, dtype=np.float64)
    joints = message.joint_state
    if len(joints.name) != len(joints.position):
        raise ValueError(f"a state with {len(joints.name)} joint names and {len(joints.position)} positions")
    for name, position in zip(joints.name, joints.position, strict=True):
        if not math.isfinite(position):
            raise ValueError(f"joint '{name}' has the position {position}")
        if name in model.variables:
            values[model.variable_index(name)] = position
    multiple = message.multi_dof_joint_state
    for name, transform in zip(multiple.joint_names, multiple.transforms, strict=False):
        if not model.has_joint(name):
            continue
        joint = model.joint(name)
        t, q = transform.translation, transform.rotation
        norm = math.hypot(q.w, q.x, q.y, q.z)
        if not math.isfinite(norm + t.x + t.y + t.z) or norm == 0.0:
            raise ValueError(f"joint '{name}' has a transform that is not finite")
        pose = Pose((t.x, t.y, t.z), (q.w / norm, q.x / norm, q.y / norm, q.z / norm))
        if joint.type == "planar":
            numbers = [t.x, t.y, pose.rpy[2]]
        else:
            w, x, y, z = pose.quaternion
            numbers = [t.x, t.y, t.z, x, y, z, w]
        for variable, number in zip(joint.variables, numbers, strict=False):
            values[model.variable_index(variable)] = number
    return model.with_mimics(values)


def is_empty_state(message: "Message") -> bool:
    """True if a moveit_msgs/RobotState says nothing: the present state is meant."""
    return not (
        len(message.joint_state.name)
        or len(message.multi_dof_joint_state.joint_names)
        or len(message.attached_collision_objects)
    )
