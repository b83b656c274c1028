"""Where the links of a URDF are for given joint positions."""

import math
from collections.abc import Mapping

from trundle.spatial import Pose, normalized

from .robot import Robot, RobotJoint


def parent_from_child(joint: RobotJoint, position: float) -> Pose:
    """The child link's frame in the parent's with the joint at `position` [rad or m]; fixed-like types ignore it."""
    if joint.type in ("fixed", "floating", "planar"):
        return joint.parent_from_joint
    x, y, z = normalized(joint.axis) or (0.0, 0.0, 0.0)
    if joint.type == "prismatic":
        return joint.parent_from_joint @ Pose((x * position, y * position, z * position))
    s = math.sin(position / 2)
    return joint.parent_from_joint @ Pose(quaternion=(math.cos(position / 2), x * s, y * s, z * s))


def root_from_links(robot: Robot, positions: Mapping[str, float]) -> dict[str, Pose]:
    """Every link's frame in the root link's; joints not named are at zero, mimics follow their leaders."""
    followed = dict(positions)
    for joint in robot.joints:
        if joint.mimic is not None and joint.name not in followed:
            leader = followed.get(joint.mimic.joint, 0.0)
            followed[joint.name] = joint.mimic.multiplier * leader + joint.mimic.offset
    below: dict[str, list[RobotJoint]] = {}
    for joint in robot.joints:
        below.setdefault(joint.parent, []).append(joint)
    found = {robot.root: Pose()}
    pending = [robot.root]
    while pending:
        parent = pending.pop()
        for joint in below.get(parent, []):
            found[joint.child] = found[parent] @ parent_from_child(joint, followed.get(joint.name, 0.0))
            pending.append(joint.child)
    return found
