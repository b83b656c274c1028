"""Initial joint positions, from the axes, or from the link poses of a saved <state>."""

import math
from collections.abc import Mapping, Sequence
from itertools import zip_longest

import mujoco
import numpy as np
from numpy.typing import NDArray

from trundle.base.diagnostics import Diagnostics
from trundle.spatial import (
    Pose,
    Quaternion,
    Vector3,
    cross,
    dot,
    quaternion_from_axis_angle,
    quaternion_product,
    rotate,
)

from .joints import Axis
from .kinematic_tree import KinematicTree, LinkNode

_FREE, _BALL, _SLIDE = (
    int(t) for t in (mujoco.mjtJoint.mjJNT_FREE, mujoco.mjtJoint.mjJNT_BALL, mujoco.mjtJoint.mjJNT_SLIDE)
)
_OFF_M, _OFF_RAD = 0.01, 0.05
"""Position and rotation error from which a saved link pose counts as unreachable."""


def initial_positions(
    model: mujoco.MjModel, tree: KinematicTree, axes: Mapping[str, Sequence[Axis]], report: Diagnostics
) -> NDArray[np.float64] | None:
    """Return the initial qpos; None if everything starts as written.

    Args:
        model: compiled with every joint at zero.
        tree: links of its bodies.
        axes: axes of its joints.
        report: receives a note for each link whose joints cannot reach its saved pose.
    """
    saved = {node.model for node in tree.links.values() if node.link.initial_pose is not None}
    moved = [
        axis
        for edge in tree.parent_joint.values()
        if tree.links[edge.child].model not in saved
        for axis in axes.get(edge.name, ())
        if axis.axis is not None and axis.axis.initial_position
    ]
    if not saved and not moved:
        return None
    saved_poses = {name: _saved_pose(node) for name, node in tree.links.items() if node.model in saved}
    bodies = dict(saved_poses)
    bodies |= {
        f"{edge.child} on {edge.name}": saved_poses[edge.child] for edge in tree.loops if edge.child in saved_poses
    }
    positions = np.array(model.qpos0)
    world_from_body = [Pose()] * model.nbody
    for i in range(1, model.nbody):
        world_from_parent = world_from_body[int(model.body_parentid[i])]
        at_zero = world_from_parent @ Pose(tuple(model.body_pos[i].tolist()), tuple(model.body_quat[i].tolist()))
        world_from_body[i] = bodies.get(model.body(i).name, at_zero)
        if model.body_jntnum[i]:
            _set_joint_positions(model, i, positions, at_zero, world_from_body[i])
    for axis in moved:
        assert axis.axis is not None
        positions[model.joint(axis.engine_joint).qposadr[0]] = axis.sign * axis.axis.initial_position
    _report_unreachable(model, positions, {name: tree.links[name] for name in saved_poses}, report)
    return positions


def _saved_pose(node: LinkNode) -> Pose:
    link = node.link
    world_from_model = node.world_from_link_at_zero @ link.model_from_link.inverse()
    return world_from_model @ (link.initial_pose or link.model_from_link)


def _set_joint_positions(
    model: mujoco.MjModel, body: int, positions: NDArray[np.float64], at_zero: Pose, target: Pose
) -> None:
    """Set the joints of a body that move it from its zero pose to the target pose."""
    first = int(model.body_jntadr[body])
    address = int(model.jnt_qposadr[first])
    moved = at_zero.inverse() @ target
    kind = int(model.jnt_type[first])
    if kind == _FREE:
        positions[address : address + 7] = (*target.position, *target.quaternion)
    elif kind == _BALL:
        positions[address : address + 4] = moved.quaternion
    else:
        joints = range(first, first + int(model.body_jntnum[body]))
        hinges = [j for j in joints if model.jnt_type[j] != _SLIDE]
        for j in joints:
            axis, anchor = _vector(model.jnt_axis[j]), _vector(model.jnt_pos[j])
            if j not in hinges:
                moved_anchor = moved.transform_point(anchor)
                positions[model.jnt_qposadr[j]] = sum(
                    (t - a) * x for t, a, x in zip(moved_anchor, anchor, axis, strict=True)
                )
        turn = moved.quaternion
        for j, after in zip_longest(hinges, hinges[1:]):
            axis = _vector(model.jnt_axis[j])
            angle = (
                _angle_about(axis, turn)
                if after is None
                else _first_axis_angle(axis, _vector(model.jnt_axis[after]), turn)
            )
            positions[model.jnt_qposadr[j]] = _wrap_into_limits(model, j, angle)
            turn = quaternion_product(quaternion_from_axis_angle(axis, -angle), turn)


def _angle_about(axis: Vector3, turn: Quaternion) -> float:
    """Return the rotation angle about an axis [rad]."""
    w, x, y, z = turn
    return math.remainder(2 * math.atan2(x * axis[0] + y * axis[1] + z * axis[2], w), math.tau)


def _first_axis_angle(axis: Vector3, inner: Vector3, turn: Quaternion) -> float:
    """Return the angle of a joint's first axis [rad], given the direction to which it has rotated the second axis."""
    rotated = rotate(turn, inner)
    across = cross(inner, rotated)
    along = dot(inner, rotated) - dot(axis, inner) * dot(axis, rotated)
    return math.atan2(dot(axis, across), along)


def _wrap_into_limits(model: mujoco.MjModel, joint: int, angle: float) -> float:
    """Return the angle, shifted by a full turn if that brings it within the limits."""
    lower, upper = (float(limit) for limit in model.jnt_range[joint])
    if not model.jnt_limited[joint] or lower <= angle <= upper:
        return angle
    return next((candidate for candidate in (angle + math.tau, angle - math.tau) if lower <= candidate <= upper), angle)


def _report_unreachable(
    model: mujoco.MjModel, positions: NDArray[np.float64], nodes: dict[str, LinkNode], report: Diagnostics
) -> None:
    data = mujoco.MjData(model)
    data.qpos[:] = positions
    mujoco.mj_kinematics(model, data)
    for name, node in nodes.items():
        body = model.body(name).id
        reached = Pose(_vector(data.xpos[body]), tuple(data.xquat[body].tolist()))
        saved = _saved_pose(node)
        rotation_error = (reached.inverse() @ saved).quaternion
        if math.dist(reached.position, saved.position) > _OFF_M or 2 * math.hypot(*rotation_error[1:]) > _OFF_RAD:
            note = f"link {node.link.name!r}: its joints cannot reach the saved pose; it starts at the nearest"
            report.info(node.link.at, note, "initial-position")


def _vector(numbers: NDArray[np.float64]) -> Vector3:
    x, y, z = numbers.tolist()
    return x, y, z
