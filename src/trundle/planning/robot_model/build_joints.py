"""Joints of a model, of a URDF and the virtual and passive joints of an SRDF."""

import math
from collections.abc import Iterator, Mapping
from typing import Any

from msgspec.structs import replace

from trundle.base.diagnostics import Diagnostics, no_such
from trundle.robots.robot import Robot, RobotJoint
from trundle.spatial import normalized

from .joint_limits import read_joint_limits
from .joint_models import FLOATING, PLANAR, JointModel, MimicModel
from .srdf import Srdf, SrdfVirtualJoint

ASSUMED_ROOT = "ASSUMED_FIXED_ROOT_JOINT"
"""MoveIt's name for the joint that holds the root link without a virtual joint."""
_UNLIMITED = (-math.inf, math.inf)
_TURN = (-math.pi, math.pi)


def build_joints(
    robot: Robot, srdf: Srdf, limits: Mapping[str, Any] | None, report: Diagnostics
) -> tuple[list[JointModel], str]:
    """Return joints, parents first, and the frame in which the model's poses are."""
    root, frame = _root_joint(robot, srdf, report)
    joints = [root, *(_joint(joint) for joint in _depth_first(robot))]
    joints = _resolve_mimics(joints, robot, report)
    joints = _mark(joints, srdf, report)
    variables = {variable: None for joint in joints for variable in joint.variables}
    by_variable = read_joint_limits(limits, variables, report)
    return [_with_limits(joint, by_variable) for joint in joints], frame


def _depth_first(robot: Robot) -> Iterator[RobotJoint]:
    """Yield joints in the order of MoveIt's variables: depth first, siblings by name."""
    children: dict[str, list[RobotJoint]] = {}
    for joint in sorted(robot.joints, key=lambda joint: joint.name, reverse=True):
        children.setdefault(joint.parent, []).append(joint)
    pending = list(children.get(robot.root, []))
    while pending:
        joint = pending.pop()
        yield joint
        pending += children.get(joint.child, [])


def _root_joint(robot: Robot, srdf: Srdf, report: Diagnostics) -> tuple[JointModel, str]:
    fitting: list[SrdfVirtualJoint] = []
    taken = {joint.name for joint in robot.joints}
    for virtual in srdf.virtual_joints:
        fault = ""
        if virtual.child_link != robot.root:
            fault = f"its child_link is {virtual.child_link!r}, not the root link {robot.root!r}"
        elif virtual.name in taken:
            fault = "a joint of the URDF has its name"
        elif fitting:
            fault = f"{fitting[0].name!r} already holds the root link"
        if fault:
            report.warn(virtual.at, f"virtual_joint {virtual.name!r}: {fault}; it is left out", "missing-link")
        else:
            fitting.append(virtual)
    if not fitting:
        return JointModel(name=ASSUMED_ROOT, type="fixed", parent_link="", child_link=robot.root), robot.root
    virtual = fitting[0]
    joint = JointModel(name=virtual.name, type=virtual.type, parent_link="", child_link=robot.root)
    # MoveIt keeps the root link as the model's frame if the joint is fixed.
    frame = robot.root if virtual.type == "fixed" else virtual.parent_frame
    return _with_variables(joint), frame


def _with_variables(joint: JointModel) -> JointModel:
    """Return a planar or floating joint with its variables; others as they are."""
    if joint.type == "planar":
        names, bounds, bounded = PLANAR, (_UNLIMITED, _UNLIMITED, _TURN), (False, False, False)
    elif joint.type == "floating":
        names, bounds = FLOATING, (_UNLIMITED,) * 3 + ((-1.0, 1.0),) * 4
        bounded = (False,) * 3 + (True,) * 4
    else:
        return joint
    return replace(
        joint,
        variables=tuple(f"{joint.name}/{name}" for name in names),
        lower=tuple(lower for lower, _ in bounds),
        upper=tuple(upper for _, upper in bounds),
        is_bounded=bounded,
        max_velocity=(None,) * len(names),
        max_acceleration=(None,) * len(names),
    )


def _joint(joint: RobotJoint) -> JointModel:
    model = JointModel(
        name=joint.name,
        type=joint.type,
        parent_link=joint.parent,
        child_link=joint.child,
        origin=joint.parent_from_joint,
        axis=normalized(joint.axis) or (1.0, 0.0, 0.0),
    )
    if joint.type not in ("revolute", "continuous", "prismatic"):
        return _with_variables(model)
    limit = joint.limit
    bounds, bounded = _TURN if joint.type == "continuous" else _UNLIMITED, False
    if joint.type != "continuous" and limit is not None:
        # As MoveIt: soft limits of a <safety_controller> narrow those of <limit>.
        soft = joint.safety
        lower = limit.lower if soft is None else max(limit.lower, soft.soft_lower_limit)
        upper = limit.upper if soft is None else min(limit.upper, soft.soft_upper_limit)
        bounds, bounded = (lower, upper) if lower <= upper else (limit.lower, limit.upper), True
    if bounds[0] > bounds[1]:
        bounds = (bounds[1], bounds[0])
    velocity = None if limit is None or limit.velocity == 0.0 else abs(limit.velocity)
    return replace(
        model,
        variables=(joint.name,),
        lower=(bounds[0],),
        upper=(bounds[1],),
        is_bounded=(bounded,),
        max_velocity=(velocity,),
        max_acceleration=(None,),
        mimic=None if joint.mimic is None else MimicModel(*_mimic_of(joint)),
    )


def _mimic_of(joint: RobotJoint) -> tuple[str, float, float]:
    assert joint.mimic is not None
    return joint.mimic.joint, joint.mimic.multiplier, joint.mimic.offset


def _resolve_mimics(joints: list[JointModel], robot: Robot, report: Diagnostics) -> list[JointModel]:
    """Let each mimic joint follow a joint that follows none; faulty ones follow nobody, as in MoveIt."""
    by_name = {joint.name: joint for joint in joints}
    at = {joint.name: joint.at for joint in robot.joints}
    resolved: list[JointModel] = []
    for joint in joints:
        mimic = joint.mimic
        seen = {joint.name}
        fault = ""
        while mimic is not None and not fault:
            leader = by_name.get(mimic.joint)
            if leader is None:
                fault = no_such("no joint", mimic.joint, by_name)
            elif leader.name in seen:
                fault = f"it follows itself, by {leader.name!r}"
            elif len(leader.variables) != 1:
                fault = f"{leader.name!r} is {leader.type}, with {len(leader.variables)} variables, not one"
            elif leader.mimic is None:
                break
            else:
                seen.add(leader.name)
                follows = leader.mimic
                mimic = MimicModel(
                    follows.joint,
                    mimic.multiplier * follows.multiplier,
                    mimic.multiplier * follows.offset + mimic.offset,
                )
        if fault:
            report.warn(at[joint.name], f"joint {joint.name!r} is no mimic: {fault}; it moves on its own", "mimic")
            mimic = None
        resolved.append(joint if mimic is joint.mimic else replace(joint, mimic=mimic))
    return _mirrored(resolved)


def _mirrored(joints: list[JointModel]) -> list[JointModel]:
    """Let each follower of a joint whose own mimic was dropped follow that joint still: leaders are free joints."""
    free = {joint.name for joint in joints if joint.mimic is None}
    return [
        joint if joint.mimic is None or joint.mimic.joint in free else replace(joint, mimic=None) for joint in joints
    ]


def _mark(joints: list[JointModel], srdf: Srdf, report: Diagnostics) -> list[JointModel]:
    """Apply <passive_joint> and <joint_property>."""
    names = {joint.name for joint in joints}
    for name in srdf.passive_joints:
        if name not in names:
            report.warn(srdf.at, f"passive_joint: {no_such('no joint', name, names)}; it is left out", "missing-link")
    for name in srdf.joint_properties:
        if name not in names:
            report.warn(srdf.at, f"joint_property: {no_such('no joint', name, names)}; it is left out", "missing-link")
    return [
        replace(
            joint,
            passive=joint.name in srdf.passive_joints,
            properties=srdf.joint_properties.get(joint.name, {}),
        )
        for joint in joints
    ]


def _with_limits(joint: JointModel, limits: Mapping[str, Mapping[str, float]]) -> JointModel:
    if not any(variable in limits for variable in joint.variables):
        return joint
    parts = [limits.get(variable, {}) for variable in joint.variables]
    lower = tuple(part.get("min_position", value) for part, value in zip(parts, joint.lower, strict=True))
    upper = tuple(part.get("max_position", value) for part, value in zip(parts, joint.upper, strict=True))
    bounded = tuple(
        flag or "min_position" in part or "max_position" in part
        for part, flag in zip(parts, joint.is_bounded, strict=True)
    )
    return replace(
        joint,
        lower=lower,
        upper=upper,
        is_bounded=bounded,
        max_velocity=tuple(
            part.get("max_velocity", value) for part, value in zip(parts, joint.max_velocity, strict=True)
        ),
        max_acceleration=tuple(
            part.get("max_acceleration", value) for part, value in zip(parts, joint.max_acceleration, strict=True)
        ),
    )
