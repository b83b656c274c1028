"""SRDF of the groups that were found."""

import numpy as np

from trundle.base.diagnostics import Source
from trundle.planning.kinematics import Kinematics
from trundle.planning.robot_model import (
    DisabledPair,
    RobotModel,
    Srdf,
    SrdfChain,
    SrdfEndEffector,
    SrdfGroup,
    SrdfState,
    SrdfVirtualJoint,
)

from .group_finder import WORLD, FoundGripper, FoundGroups

_AT = Source("setup_assistant")


def semantics(model: RobotModel, found: FoundGroups, disabled: list[DisabledPair]) -> Srdf:
    """Return groups, states, end effectors, the joint to the world, and pairs that are not checked."""
    groups: list[SrdfGroup] = []
    states: list[SrdfState] = []
    effectors: list[SrdfEndEffector] = []
    for arm in found.arms:
        chain = SrdfChain(base_link=arm.base_link, tip_link=arm.tip_link)
        groups.append(SrdfGroup(name=arm.name, at=_AT, chains=(chain,)))
        default = model.default_positions()
        home = {name: (float(default[model.variable_index(name)]),) for name in arm.joints}
        states.append(SrdfState(name="home", group=arm.name, at=_AT, positions=home))
        if arm.gripper is None:
            continue
        gripper = arm.gripper
        groups.append(SrdfGroup(name=gripper.name, at=_AT, joints=gripper.joints, links=gripper.links))
        states += _open_and_closed(model, gripper)
        effector = SrdfEndEffector(
            name=gripper.name, group=gripper.name, parent_link=gripper.parent_link, parent_group=arm.name, at=_AT
        )
        effectors.append(effector)
    return Srdf(
        name=model.name,
        at=_AT,
        groups=tuple(groups),
        states=tuple(states),
        end_effectors=tuple(effectors),
        virtual_joints=_virtual_joints(model, found),
        passive_joints=found.wheels,
        disabled=tuple(disabled),
    )


def _virtual_joints(model: RobotModel, found: FoundGroups) -> tuple[SrdfVirtualJoint, ...]:
    """Return the joint that holds the root: fixed to the world, or planar for a robot on wheels."""
    if model.root_link == WORLD:
        return ()
    if len(found.wheels) >= 2:
        frames = {"parent_frame": "odom", "child_link": model.root_link}
        return (SrdfVirtualJoint(name="world_joint", type="planar", at=_AT, **frames),)
    return (
        SrdfVirtualJoint(name="virtual_joint", type="fixed", parent_frame=WORLD, child_link=model.root_link, at=_AT),
    )


def _open_and_closed(model: RobotModel, gripper: FoundGripper) -> list[SrdfState]:
    """Return the state with the fingers apart, and the one with them together."""
    active = [name for name in gripper.joints if model.joint(name).is_active]
    indices = model.indices(active)
    ends: list[np.ndarray[tuple[int], np.dtype[np.float64]]] = []
    for limits in (model.lower, model.upper):
        state = model.default_positions()
        state[indices] = np.clip(limits[indices], -10.0, 10.0)
        ends.append(model.with_mimics(state))
    fingers = [model.links.index(model.joint(name).child_link) for name in gripper.joints]
    spans = [_span(Kinematics(model).link_poses(state)[fingers, :3]) for state in ends]
    closed, opened = ends if spans[0] <= spans[1] else reversed(ends)
    return [
        SrdfState(
            name=name,
            group=gripper.name,
            at=_AT,
            positions={joint: (float(state[index]),) for joint, index in zip(active, indices, strict=True)},
        )
        for name, state in (("open", opened), ("closed", closed))
    ]


def _span(points: "np.ndarray[tuple[int, int], np.dtype[np.float64]]") -> float:
    """Return the sum of the distances of points [m]."""
    return float(np.linalg.norm(points[:, None] - points[None, :], axis=-1).sum())
