"""Goals of pickup and place as manipulations."""

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

import numpy as np
from msgspec.structs import replace

from trundle.base.diagnostics import TrundleError
from trundle.planning.planning_scene import OCTOMAP
from trundle.spatial import Pose, Vector3

from ..controllers import JointPath, path_from_message
from ..scene import CarriedObject, Frames, SceneContents, SceneObject, pose_of
from .manipulation_plan import ManipulationGoal, Translation

if TYPE_CHECKING:
    from trundle.planning.robot_model import EndEffector, RobotModel
    from trundle.ros import Message

    from ..move_group_context import MoveGroupContext

_DEFAULT_MIN_M, _DEFAULT_M = 0.1, 0.2


class RequestError(TrundleError):
    """A goal that names what is not there."""


def _end_effector(model: "RobotModel", name: str, group: str) -> "EndEffector":
    """Return the end effector asked for, or the one that a group moves; `name` may be its group's.

    Raises:
        RequestError: there is none.
    """
    effectors = list(model.end_effectors.values())
    if name:
        found = [one for one in effectors if name in (one.name, one.group)]
    elif group in model.groups:
        found = [one for one in effectors if one.name in model.groups[group].attached_end_effectors]
        if not found:
            found = [one for one in effectors if one.parent_group == group or one.group == group]
    else:
        found = effectors
    if not found:
        known = ", ".join(one.name for one in effectors) or "none"
        what = f"'{name}'" if name else f"of group '{group}'"
        raise RequestError(f"No end-effector {what} specified for pick action; end effectors: {known}")
    return found[0]


def _arm_group(model: "RobotModel", effector: "EndEffector", group: str) -> str:
    """Return the group that moves the hand.

    Raises:
        RequestError: none does.
    """
    if group and group in model.groups and group != effector.group:
        return group
    if effector.parent_group:
        return effector.parent_group
    for name, candidate in model.groups.items():
        if candidate.is_chain and candidate.links and candidate.links[-1] == effector.parent_link:
            return name
    raise RequestError(f"Could not compute the group that moves end effector '{effector.name}'; name it in the goal")


def pick_goals(
    context: "MoveGroupContext", goal: "Message", contents: SceneContents, frames: Frames
) -> list[ManipulationGoal]:
    """Return the manipulations of a moveit_msgs/PickupGoal, the best grasp first.

    Raises:
        RequestError: the object or the end effector is not there.
        ValueError: a pose is not finite.
    """
    model = context.monitor.model
    name = str(goal.target_name)
    if name not in contents.objects:
        known = ", ".join(contents.objects) or "none"
        raise RequestError(f"The object '{name}' to pick is not in the planning scene; objects: {known}")
    effector = _end_effector(model, str(goal.end_effector), str(goal.group_name))
    group = _arm_group(model, effector, str(goal.group_name))
    hand = (
        [*model.groups[effector.group].links, effector.parent_link]
        if effector.group in model.groups
        else [effector.parent_link]
    )
    touch_links = [str(one) for one in goal.attached_object_touch_links] or list(dict.fromkeys(hand))
    grasps = list(goal.possible_grasps) or [_default_grasp(context, name, effector)]
    order = sorted(range(len(grasps)), key=lambda index: -float(grasps[index].grasp_quality))
    goals: list[ManipulationGoal] = []
    for index in order:
        grasp = grasps[index]
        model_from_hand = frames.find(str(grasp.grasp_pose.header.frame_id)) @ pose_of(grasp.grasp_pose.pose)
        before = contents.copy()
        touched = [
            name,
            *(str(one) for one in grasp.allowed_touch_objects),
            *(str(o) for o in goal.allowed_touch_objects),
        ]
        _allow(before, touched, [*hand, *touch_links])
        _allow_surroundings(before, goal, name, hand)
        after = before.copy()
        item = after.objects.pop(name)
        hand_from_item = model_from_hand.inverse() @ item.pose
        after.carried[name] = CarriedObject(
            object=_at(item, hand_from_item),
            link=effector.parent_link,
            touch_links=tuple(dict.fromkeys(touch_links)),
            detach_posture=grasp.pre_grasp_posture if len(grasp.pre_grasp_posture.joint_names) else None,
        )
        goals.append(
            ManipulationGoal(
                number=index,
                group=group,
                hand_link=effector.parent_link,
                hand_group=effector.group,
                model_from_hand=model_from_hand,
                approach=_translation(grasp.pre_grasp_approach, effector, model_from_hand, frames),
                retreat=_translation(grasp.post_grasp_retreat, effector, model_from_hand, frames),
                approach_posture=_posture(context, grasp.pre_grasp_posture),
                closing_posture=_posture(context, grasp.grasp_posture),
                before=before,
                after=after,
                names=("pre_grasp", "grasp"),
            )
        )
    return goals


def place_goals(
    context: "MoveGroupContext", goal: "Message", contents: SceneContents, frames: Frames
) -> list[ManipulationGoal]:
    """Return the manipulations of a moveit_msgs/PlaceGoal, the best location first.

    Raises:
        RequestError: nothing is attached, or there is no location.
        ValueError: a pose is not finite.
    """
    model = context.monitor.model
    name = str(goal.attached_object_name) or next(iter(contents.carried), "")
    carried = contents.carried.get(name)
    if carried is None:
        known = ", ".join(contents.carried) or "none"
        raise RequestError(f"No object attached '{name}' to place; attached objects: {known}")
    wanted = str(goal.group_name)
    effectors = [one for one in model.end_effectors.values() if one.parent_link == carried.link]
    effector = effectors[0] if effectors else _end_effector(model, "", wanted)
    group = _arm_group(model, effector, wanted)
    if not len(goal.place_locations):
        raise RequestError("a place goal without locations; name where the object is to be placed")
    hand = list(model.groups[effector.group].links) if effector.group in model.groups else []
    hand = list(dict.fromkeys([*hand, effector.parent_link, *carried.touch_links]))
    hand_from_item = (frames.link(effector.parent_link).inverse() @ frames.link(carried.link)) @ carried.object.pose
    locations = list(goal.place_locations)
    order = sorted(range(len(locations)), key=lambda index: -float(locations[index].quality))
    goals: list[ManipulationGoal] = []
    for index in order:
        location = locations[index]
        model_from_place = frames.find(str(location.place_pose.header.frame_id)) @ pose_of(location.place_pose.pose)
        model_from_hand = model_from_place if goal.place_eef else model_from_place @ hand_from_item.inverse()
        before = contents.copy()
        touched = [*(str(o) for o in location.allowed_touch_objects), *(str(o) for o in goal.allowed_touch_objects)]
        _allow(before, touched, [name, *hand])
        _allow_surroundings(before, goal, name, hand)
        after = before.copy()
        item = after.carried.pop(name)
        after.objects[name] = _at(item.object, model_from_hand @ hand_from_item)
        _allow(after, [name], hand)
        posture = location.post_place_posture
        if not len(posture.joint_names) and carried.detach_posture is not None:
            posture = carried.detach_posture
        goals.append(
            ManipulationGoal(
                number=index,
                group=group,
                hand_link=effector.parent_link,
                hand_group=effector.group,
                model_from_hand=model_from_hand,
                approach=_translation(location.pre_place_approach, effector, model_from_hand, frames),
                retreat=_translation(location.post_place_retreat, effector, model_from_hand, frames),
                approach_posture=None,
                closing_posture=_posture(context, posture),
                before=before,
                after=after,
                names=("pre_place", "place"),
            )
        )
    return goals


def _at(item: SceneObject, pose: Pose) -> SceneObject:
    return replace(item, pose=pose)


def _allow_surroundings(contents: SceneContents, goal: "Message", name: str, hand: Sequence[str]) -> None:
    """Let the object, and where the goal says so the hand, touch the octomap and the support surface."""
    _allow(contents, [OCTOMAP], [name])
    support = str(goal.support_surface_name)
    if support:
        _allow(contents, [support], [*hand, name] if goal.allow_gripper_support_collision else [name])


def _allow(contents: SceneContents, names: Iterable[str], others: Iterable[str]) -> None:
    others = list(others)
    for name in names:
        contents.allowed.set_entries(name, others, True)


def _translation(message: "Message", effector: "EndEffector", model_from_hand: Pose, frames: Frames) -> Translation:
    """Read a moveit_msgs/GripperTranslation; a direction in the hand's frame turns with it."""
    v = message.direction.vector
    vector: Vector3 = (float(v.x), float(v.y), float(v.z))
    frame = str(message.direction.header.frame_id).lstrip("/")
    base = model_from_hand if frame == effector.parent_link else frames.find(frame)
    x, y, z = base.transform_vector(vector)
    norm = math.sqrt(x * x + y * y + z * z)
    if not math.isfinite(norm) or norm < 1e-6:
        return Translation(direction=(0.0, 0.0, 0.0), desired_m=0.0, min_m=0.0)
    desired, minimum = float(message.desired_distance), float(message.min_distance)
    return Translation(
        direction=(x / norm, y / norm, z / norm), desired_m=max(desired, minimum, 0.0), min_m=max(minimum, 0.0)
    )


def _posture(context: "MoveGroupContext", message: "Message") -> JointPath | None:
    """Read a posture; joints that the robot does not have are an error.

    Raises:
        RequestError: an unknown joint.
        TrajectoryError: points are invalid.
    """
    if not len(message.joint_names) or not len(message.points):
        return None
    path = path_from_message(message)
    for name in path.joints:
        if not context.monitor.model.has_joint(name):
            raise RequestError(f"joint '{name}' of the posture is not part of the robot")
    return path


def _default_grasp(context: "MoveGroupContext", name: str, effector: "EndEffector") -> "Message":
    """Return the grasp that the original makes up: at the object's origin, from above."""
    model = context.monitor.model
    joints = list(model.groups[effector.group].joints) if effector.group in model.groups else []
    indices = [model.variable_index(joint) for joint in joints]

    def posture(limits: np.ndarray) -> dict[str, object]:
        return {"joint_names": joints, "points": [{"positions": [float(limits[i]) for i in indices]}]}

    frame = {"frame_id": model.model_frame}

    def along(z: float) -> dict[str, object]:
        direction = {"header": frame, "vector": {"z": z}}
        return {"direction": direction, "min_distance": _DEFAULT_MIN_M, "desired_distance": _DEFAULT_M}

    return context.node.new(
        "moveit_msgs/Grasp",
        {
            "grasp_pose": {"header": {"frame_id": name}, "pose": {"orientation": {"w": 1.0}}},
            "pre_grasp_approach": along(-1.0),
            "post_grasp_retreat": along(1.0),
            "pre_grasp_posture": posture(model.upper) if joints else {},
            "grasp_posture": posture(model.lower) if joints else {},
        },
    )
