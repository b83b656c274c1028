"""Forward kinematics of a URDF."""

from collections.abc import Mapping

from trundle.spatial import ZERO, Pose, multiply, normalized, quaternion_from_axis_angle

from .urdf_tree import Robot, RobotJoint


def parent_from_child(joint: RobotJoint, position: float) -> Pose:
    """Return the child link's frame in the parent's with the joint at `position` [rad or m], which fixed, floating and
    planar joints ignore.
    """
    if joint.type in ("fixed", "floating", "planar"):
        return joint.parent_from_joint
    axis = normalized(joint.axis) or ZERO
    if joint.type == "prismatic":
        return joint.parent_from_joint @ Pose(multiply(axis, position))
    return joint.parent_from_joint @ Pose(quaternion=quaternion_from_axis_angle(axis, position))


def root_from_links(robot: Robot, positions: Mapping[str, float]) -> dict[str, Pose]:
    """Return every link's frame in the root link's; joints not named are at zero, mimic joints follow their leaders."""
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
