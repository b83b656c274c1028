"""Forward kinematics of a model, without a physics engine."""

from collections.abc import Mapping

from trundle.spatial import Pose, Vector3, multiply, quaternion_from_axis_angle

from .joint import Joint, JointType
from .kinematic_model import Model


def model_from_joint(model: Model, joint: Joint) -> Pose:
    """Return the joint frame in the model frame with every joint at zero."""
    return _model_from_link(model, joint.child) @ joint.child_from_joint


def _model_from_link(model: Model, name: str) -> Pose:
    if name == "world":
        return model.world_from_model.inverse()
    inner, is_nested, rest = name.partition("::")
    if is_nested and all(link.name != name for link in model.links):
        nested = next(nested for nested in model.models if nested.name == inner)
        return nested.world_from_model @ _model_from_link(nested, rest)
    return model.link(name).model_from_link


def joint_motion(joint: Joint, position: float) -> Pose:
    """Return the motion of a single-axis joint's child at `position` [rad or m].

    The pose is a motion in axes parallel to the model frame, with the joint's anchor as origin.
    """
    if joint.axis is None:
        return Pose()
    if joint.type is JointType.PRISMATIC:
        return Pose(multiply(joint.axis.direction, position))
    return Pose(quaternion=quaternion_from_axis_angle(joint.axis.direction, position))


def model_from_links(model: Model, positions: Mapping[str, float]) -> dict[str, Pose]:
    """Return link poses in the model frame for joint positions [rad or m]; joints not named are at zero.

    Root links stay at their written pose.
    """
    at_zero = {link.name: link.model_from_link for link in model.links}
    parent_joint = {joint.child: joint for joint in reversed(model.joints)}
    result: dict[str, Pose] = {}

    def place_link(name: str, descendants: frozenset[str]) -> Pose:
        if name in result:
            return result[name]
        joint = parent_joint.get(name)
        if joint is None or joint.parent not in at_zero or joint.parent in descendants:
            result[name] = at_zero[name]
            return result[name]
        parent = place_link(joint.parent, descendants | {name})
        anchor = model_from_joint(model, joint).position
        motion = joint_motion(joint, positions.get(joint.name, 0.0))
        moved = _about(anchor, motion) @ at_zero[name]
        result[name] = parent @ at_zero[joint.parent].inverse() @ moved
        return result[name]

    for link in model.links:
        place_link(link.name, frozenset())
    return result


def _about(anchor: Vector3, motion: Pose) -> Pose:
    """Return the motion taken about `anchor` instead of the origin."""
    x, y, z = anchor
    return Pose(anchor) @ motion @ Pose((-x, -y, -z))
