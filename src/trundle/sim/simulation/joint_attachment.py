"""Joints attached while the world runs."""

from msgspec.structs import replace

from trundle.base.diagnostics import UsageError
from trundle.robots.model import Joint, JointAxis, JointType, World
from trundle.spatial import Pose

from .handles import LinkHandle, ModelHandle
from .world_edits import WORLD, with_model_at


def with_joint(world: World, models: list[ModelHandle], joint: Joint) -> World:
    """Return the world with a joint between models whose zero position is the current configuration.

    A fixed joint stores the pose of the child; for other types the child's model is moved so that the joint is at zero.

    Args:
        world: current world.
        models: handles with the current poses.
        joint: joint with links `model::link` or "world"; axes in the world frame in the current configuration.

    Raises:
        UsageError: a link does not exist, or the joint's name is taken.
    """
    if any(other.name == joint.name for other in world.joints):
        raise UsageError(f"there is a joint {joint.name!r} already")
    parent, child = _find(models, joint.parent), _find(models, joint.child)
    if child is None:
        raise UsageError(f"joint {joint.name!r}: the child must be a link")
    if joint.type is JointType.FIXED:
        parent_from_world = Pose() if parent is None else parent[1].pose.inverse()
        fixed = replace(joint, parent_from_child=parent_from_world @ child[1].pose)
        return replace(world, joints=(*world.joints, fixed))
    zero_from_current = Pose() if parent is None else _at_zero(*parent) @ parent[1].pose.inverse()
    world_from_model = (zero_from_current @ child[1].pose) @ child[1].link.model_from_link.inverse()

    joint = replace(
        joint, axis=_rotated_axis(joint.axis, zero_from_current), axis2=_rotated_axis(joint.axis2, zero_from_current)
    )
    # With parent and child in one model, moving the model would move both.
    edited = (
        world if parent is not None and parent[0] is child[0] else with_model_at(world, child[0].name, world_from_model)
    )
    return replace(edited, joints=(*world.joints, joint))


def _find(models: list[ModelHandle], name: str) -> tuple[ModelHandle, LinkHandle] | None:
    if name == WORLD:
        return None
    for model in models:
        for link in model.links:
            if f"{model.name}::{link.name}" == name:
                return model, link
    raise UsageError(f"no link {name!r}; links are named 'model::link'")


def _at_zero(model: ModelHandle, link: LinkHandle) -> Pose:
    return model.model.world_from_model @ link.link.model_from_link


def _rotated_axis(axis: JointAxis | None, rotation: Pose) -> JointAxis | None:
    return None if axis is None else replace(axis, direction=rotation.transform_vector(axis.direction))
