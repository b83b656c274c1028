"""Index from the names of a world to ids and addresses of the MuJoCo model."""

from collections.abc import Mapping, Sequence

import mujoco
import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.robots.model import JointAxis, World
from trundle.spatial import ZERO, Vector3

from .joints import Axis
from .kinematic_tree import JointEdge, KinematicTree

_Indices = NDArray[np.intp]
_WIDTH = {int(mujoco.mjtJoint.mjJNT_BALL): 3}


class CompiledWorld(Struct, frozen=True, eq=False):
    """MuJoCo model and its index; links and joints in file order, joints between models last."""

    world: World
    model: mujoco.MjModel
    link_names: tuple[str, ...]
    """`model::link`"""
    joint_names: tuple[str, ...]
    """`model::joint`"""
    link_bodies: _Indices
    joint_axes: tuple[range, ...]
    """Axes of each joint, as indices into the arrays below; a ball joint has three."""
    joint_anchors: tuple[tuple[int, Vector3, float], ...]
    """Per joint: its child link's index, its anchor in that link's frame [m], and 1; for a joint reversed in the tree
    the parent link's, and −1. A loop joint has index −1.
    """
    first_axes: _Indices
    """First axis of each joint; −1 if it has none."""
    axis_qpos: _Indices
    """Address of the axis in qpos; for the axes of a ball joint, the address of its quaternion."""
    axis_dof: _Indices
    axis_actuator: _Indices
    """Actuator of the axis; −1 for a ball joint."""
    axis_sign: NDArray[np.float64]
    """−1 if MuJoCo's position has the opposite sign."""
    axis_effort: NDArray[np.float64]
    """Largest actuation [N·m or N]."""
    axis_velocity: NDArray[np.float64]
    """Speed above which an effort does not accelerate the axis further [rad/s or m/s]."""
    axis_range: NDArray[np.float64]
    """(axes, 2) limits [rad or m]."""
    ball_joints: tuple[int, ...]
    """First axis of each ball joint."""
    geom_collisions: tuple[str, ...]
    """`model::link::collision` of each geom."""
    initial_qpos: NDArray[np.float64] | None = None
    """qpos at the start; None: as written in the file."""


def index_world(
    world: World,
    tree: KinematicTree,
    axes: Mapping[str, Sequence[Axis]],
    collisions: Mapping[str, str],
    model: mujoco.MjModel,
) -> CompiledWorld:
    """Resolve every name in a compiled model."""
    qpos: list[int] = []
    dof: list[int] = []
    actuator: list[int] = []
    sign: list[float] = []
    effort: list[float] = []
    velocity: list[float] = []
    limits: list[list[float]] = []
    spans: list[range] = []
    numbers = {name: number for number, name in enumerate(tree.links)}
    balls: list[int] = []
    for edge in tree.joints:
        first = len(qpos)
        for axis in axes.get(edge.name, ()):
            joint = model.joint(axis.engine_joint)
            if axis.axis is None:
                balls.append(len(qpos))
            for i in range(_WIDTH.get(int(joint.type[0]), 1)):
                qpos.append(int(joint.qposadr[0]))
                dof.append(int(joint.dofadr[0]) + i)
                actuator.append(-1 if axis.axis is None else model.actuator(axis.engine_joint).id)
                sign.append(axis.sign)
                effort.append(np.inf if axis.axis is None else axis.axis.effort)
                limits.append(_limits(axis.axis))
                velocity.append(np.inf if axis.axis is None else axis.axis.velocity)
        spans.append(range(first, len(qpos)))
    return CompiledWorld(
        world=world,
        model=model,
        link_names=tuple(tree.links),
        joint_names=tuple(edge.name for edge in tree.joints),
        link_bodies=np.array([model.body(name).id for name in tree.links], dtype=np.intp),
        joint_axes=tuple(spans),
        joint_anchors=tuple(_joint_anchor(edge, tree, numbers) for edge in tree.joints),
        first_axes=np.array([span.start if span else -1 for span in spans], dtype=np.intp),
        axis_qpos=np.array(qpos, dtype=np.intp),
        axis_dof=np.array(dof, dtype=np.intp),
        axis_actuator=np.array(actuator, dtype=np.intp),
        axis_sign=np.array(sign),
        axis_effort=np.array(effort),
        axis_velocity=np.array(velocity),
        axis_range=np.array(limits).reshape(-1, 2),
        ball_joints=tuple(balls),
        geom_collisions=tuple(collisions.get(model.geom(i).name, "") for i in range(model.ngeom)),
    )


def _joint_anchor(edge: JointEdge, tree: KinematicTree, numbers: Mapping[str, int]) -> tuple[int, Vector3, float]:
    for link, sign in ((edge.child, 1.0), (edge.parent, -1.0)):
        joint = tree.parent_joint.get(link)
        if joint is not None and joint.name == edge.name:
            anchor = tree.links[link].world_from_link_at_zero.inverse().transform_point(edge.world_from_joint.position)
            return numbers[link], anchor, sign
    return -1, ZERO, 1.0


def _limits(axis: JointAxis | None) -> list[float]:
    """Return the limits [rad or m]. Ball joints, and mimic joints with lower == upper, are unlimited."""
    return [-np.inf, np.inf] if axis is None or axis.is_rigid else sorted((axis.lower, axis.upper))
