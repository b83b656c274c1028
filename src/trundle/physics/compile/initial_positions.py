"""Where joints start: where their axes say, and in a saved world where its <state> has the links."""

import math
from collections.abc import Mapping, Sequence
from itertools import zip_longest

import mujoco
import numpy as np
from numpy.typing import NDArray

from trundle.diagnostics import Diagnostics
from trundle.spatial import Pose, Quaternion, Vector3, cross, quaternion_product, rotate

from .joints import Axis
from .kinematic_tree import LinkNode, Tree

_FREE, _BALL, _SLIDE = (
    int(t) for t in (mujoco.mjtJoint.mjJNT_FREE, mujoco.mjtJoint.mjJNT_BALL, mujoco.mjtJoint.mjJNT_SLIDE)
)
_OFF_M, _OFF_RAD = 0.01, 0.05
"""A link saved further than this from where its joints can take it is named."""


def initial_positions(
    model: mujoco.MjModel, tree: Tree, axes: Mapping[str, Sequence[Axis]], report: Diagnostics
) -> NDArray[np.float64] | None:
    """The engine's qpos at the start; None where everything starts as it is written.

    Args:
        model: compiled with every joint at zero.
        tree: the links that its bodies are.
        axes: the freedoms of its joints.
        report: takes a note of each link that its joints cannot take to where it was saved.
    """
    saved = {place.model for place in tree.places.values() if place.link.start is not None}
    moved = [
        axis
        for hold in tree.parent_joint.values()
        if tree.places[hold.below].model not in saved
        for axis in axes.get(hold.name, ())
        if axis.axis is not None and axis.axis.initial_position
    ]
    if not saved and not moved:
        return None
    wanted = {name: _saved(place) for name, place in tree.places.items() if place.model in saved}
    bodies = dict(wanted)
    bodies |= {f"{hold.below} on {hold.name}": wanted[hold.below] for hold in tree.loops if hold.below in wanted}
    positions = np.array(model.qpos0)
    world_from_body = [Pose()] * model.nbody
    for i in range(1, model.nbody):
        above = world_from_body[int(model.body_parentid[i])]
        at_zero = above @ Pose(tuple(model.body_pos[i].tolist()), tuple(model.body_quat[i].tolist()))
        world_from_body[i] = bodies.get(model.body(i).name, at_zero)
        if model.body_jntnum[i]:
            _put(model, i, positions, at_zero, world_from_body[i])
    for axis in moved:
        assert axis.axis is not None
        positions[model.joint(axis.engine_joint).qposadr[0]] = axis.sign * axis.axis.initial_position
    _name_strays(model, positions, {name: tree.places[name] for name in wanted}, report)
    return positions


def _saved(place: LinkNode) -> Pose:
    link = place.link
    world_from_model = place.at_zero @ link.model_from_link.inverse()
    return world_from_model @ (link.start or link.model_from_link)


def _put(model: mujoco.MjModel, body: int, positions: NDArray[np.float64], at_zero: Pose, wanted: Pose) -> None:
    """Set the joints of a body so that they take it from where it is at zero to where it is wanted."""
    first = int(model.body_jntadr[body])
    address = int(model.jnt_qposadr[first])
    moved = at_zero.inverse() @ wanted
    kind = int(model.jnt_type[first])
    if kind == _FREE:
        positions[address : address + 7] = (*wanted.position, *wanted.quaternion)
    elif kind == _BALL:
        positions[address : address + 4] = moved.quaternion
    else:
        joints = range(first, first + int(model.body_jntnum[body]))
        hinges = [j for j in joints if model.jnt_type[j] != _SLIDE]
        for j in joints:
            axis, anchor = _vector(model.jnt_axis[j]), _vector(model.jnt_pos[j])
            if j not in hinges:
                there = moved.point(anchor)
                positions[model.jnt_qposadr[j]] = sum((t - a) * x for t, a, x in zip(there, anchor, axis, strict=True))
        turn = moved.quaternion
        for j, after in zip_longest(hinges, hinges[1:]):
            axis = _vector(model.jnt_axis[j])
            angle = _about(axis, turn) if after is None else _between(axis, _vector(model.jnt_axis[after]), turn)
            positions[model.jnt_qposadr[j]] = _within(model, j, angle)
            turn = quaternion_product(_turn(axis, -angle), turn)


def _about(axis: Vector3, turn: Quaternion) -> float:
    """How far a rotation turns about an axis [rad]."""
    w, x, y, z = turn
    return math.remainder(2 * math.atan2(x * axis[0] + y * axis[1] + z * axis[2], w), math.tau)


def _between(axis: Vector3, inner: Vector3, turn: Quaternion) -> float:
    """How far a joint's first axis has turned [rad], from where that took the second."""
    there = rotate(turn, inner)
    across = cross(inner, there)
    along = _dot(inner, there) - _dot(axis, inner) * _dot(axis, there)
    return math.atan2(_dot(axis, across), along)


def _turn(axis: Vector3, angle: float) -> Quaternion:
    s = math.sin(angle / 2)
    return (math.cos(angle / 2), axis[0] * s, axis[1] * s, axis[2] * s)


def _within(model: mujoco.MjModel, joint: int, angle: float) -> float:
    """The same angle, a full turn on or back where that is within the limits."""
    lower, upper = (float(limit) for limit in model.jnt_range[joint])
    if not model.jnt_limited[joint] or lower <= angle <= upper:
        return angle
    return next((each for each in (angle + math.tau, angle - math.tau) if lower <= each <= upper), angle)


def _name_strays(
    model: mujoco.MjModel, positions: NDArray[np.float64], places: dict[str, LinkNode], report: Diagnostics
) -> None:
    data = mujoco.MjData(model)
    data.qpos[:] = positions
    mujoco.mj_kinematics(model, data)
    for name, place in places.items():
        body = model.body(name).id
        there = Pose(_vector(data.xpos[body]), tuple(data.xquat[body].tolist()))
        wanted = _saved(place)
        off = (there.inverse() @ wanted).quaternion
        if math.dist(there.position, wanted.position) > _OFF_M or 2 * math.hypot(*off[1:]) > _OFF_RAD:
            what = f"link {place.link.name!r} was saved where its joints cannot take it; it starts as near as they can"
            report.info(place.link.at, what)


def _vector(numbers: NDArray[np.float64]) -> Vector3:
    x, y, z = numbers.tolist()
    return x, y, z


def _dot(a: Vector3, b: Vector3) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
