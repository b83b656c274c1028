"""Forward kinematics of a URDF."""

from collections.abc import Mapping

from trundle.spatial import ZERO, Pose, multiply, normalized, quaternion_from_axis_angle

from .urdf_tree import Robot, RobotJoint


def parent_from_child(joint: RobotJoint, position: float) -> Pose:
    """Return the child link's pose in the parent's frame at `position` [rad or m]; fixed, floating and planar joints
    ignore it.
    """
    if joint.type in ("fixed", "floating", "planar"):
        return joint.parent_from_joint
    axis = normalized(joint.axis) or ZERO
    if joint.type == "prismatic":
        return joint.parent_from_joint @ Pose(multiply(axis, position))
    return joint.parent_from_joint @ Pose(quaternion=quaternion_from_axis_angle(axis, position))


def root_from_links(robot: Robot, positions: Mapping[str, float]) -> dict[str, Pose]:
    """Return link poses in the root link's frame; other joints are at zero, mimic joints follow their leaders."""
    joint_positions = dict(positions)
    for joint in robot.joints:
        if joint.mimic is not None and joint.name not in joint_positions:
            leader = joint_positions.get(joint.mimic.joint, 0.0)
            joint_positions[joint.name] = joint.mimic.multiplier * leader + joint.mimic.offset
    joints_by_parent: dict[str, list[RobotJoint]] = {}
    for joint in robot.joints:
        joints_by_parent.setdefault(joint.parent, []).append(joint)
    poses = {robot.root: Pose()}
    pending = [robot.root]
    while pending:
        parent = pending.pop()
        for joint in joints_by_parent.get(parent, []):
            poses[joint.child] = poses[parent] @ parent_from_child(joint, joint_positions.get(joint.name, 0.0))
            pending.append(joint.child)
    return poses
