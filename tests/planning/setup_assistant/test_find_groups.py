"""Arms, grippers and wheels are found in the tree of joints."""

import pytest
from tests.planning.arms import arm

from trundle.planning.robot_model import RobotModel, robot_model
from trundle.planning.setup_assistant import FoundArm, find_groups


def _robot(*joints: tuple[str, str, str, str]) -> RobotModel:
    """Return a robot of joints (type, name, parent, child); `mimic`: prismatic, follows the one before."""
    links = dict.fromkeys(link for _, _, parent, child in joints for link in (parent, child))
    text = "".join(f"<link name='{link}'/>" for link in links)
    before = ""
    for kind, name, parent, child in joints:
        mimic = f"<mimic joint='{before}'/>" if kind == "mimic" else ""
        type_ = "prismatic" if kind == "mimic" else kind
        text += f"<joint name='{name}' type='{type_}'><parent link='{parent}'/><child link='{child}'/>"
        text += f"<limit lower='0' upper='1' effort='1' velocity='1'/>{mimic}</joint>"
        before = name
    return robot_model(f"<robot name='r'>{text}</robot>")


def _chain(prefix: str, start: str, count: int) -> list[tuple[str, str, str, str]]:
    links = [start, *(f"{prefix}link_{i}" for i in range(1, count + 1))]
    return [("revolute", f"{prefix}joint_{i}", links[i - 1], links[i]) for i in range(1, count + 1)]


def _one(model: RobotModel) -> FoundArm:
    (found,) = find_groups(model).arms
    return found


@pytest.mark.parametrize(
    ("name", "base", "tip", "gripper"),
    [
        ("six_axis", "base_link", "tool0", ("left_finger_joint", "right_finger_joint")),
        ("seven_axis", "base_link", "flange", ()),
        ("scara", "base_link", "tool", ()),
        ("four_axis", "base", "grip_center", ("grip",)),
    ],
)
def test_the_small_arms(name: str, base: str, tip: str, gripper: tuple[str, ...]) -> None:
    found = _one(arm(name))

    assert (found.name, found.base_link, found.tip_link) == ("arm", base, tip)
    assert found.joints == arm(name).group("arm").joints
    assert gripper == (found.gripper.joints if found.gripper else ())


def test_the_palm_belongs_to_the_gripper() -> None:
    found = _one(arm("six_axis")).gripper

    assert found is not None
    assert (found.name, found.parent_link, found.links) == ("gripper", "tool0", ("hand",))


def test_two_arms_on_a_torso_have_sides() -> None:
    torso = [("prismatic", "lift", "base", "torso")]
    model = _robot(*torso, *_chain("left_arm_", "torso", 6), *_chain("right_arm_", "torso", 6))
    found = find_groups(model).arms

    assert [arm.name for arm in found] == ["left_arm", "right_arm"]
    assert [arm.base_link for arm in found] == ["torso", "torso"]
    assert found[1].joints == tuple(f"right_arm_joint_{i}" for i in range(1, 7))


def test_arms_without_sides_are_numbered() -> None:
    found = find_groups(_robot(*_chain("a", "base", 3), *_chain("b", "base", 4))).arms

    assert [arm.name for arm in found] == ["1_arm", "2_arm"]


def test_an_arm_begins_at_the_link_to_which_it_is_fixed() -> None:
    """As universal_robot's base_link, but not at the world, nor at a torso with two arms."""
    flange = [("fixed", "mount", "base_link", "base_inertia"), *_chain("", "base_inertia", 6)]
    torso = [("fixed", f"{side}_mount", "torso", f"{side}_base") for side in "lr"]
    arms = [joint for side in "lr" for joint in _chain(f"{side}_", f"{side}_base", 6)]

    assert _one(_robot(*flange)).base_link == "base_link"
    assert _one(_robot(("fixed", "root", "world", "base_link"), *flange)).base_link == "base_link"
    found = find_groups(_robot(*torso, *arms)).arms
    assert [(arm.name, arm.base_link) for arm in found] == [("left_arm", "l_base"), ("right_arm", "r_base")]


def test_wheels_belong_to_no_arm() -> None:
    wheels = [("continuous", f"wheel_{side}", "base", f"wheel_{side}_link") for side in "lr"]
    found = find_groups(_robot(*wheels, *_chain("", "base", 5)))

    assert found.wheels == ("wheel_l", "wheel_r")
    assert [len(arm.joints) for arm in found.arms] == [5]


def test_a_parallel_gripper_at_the_last_link() -> None:
    fingers = [
        ("prismatic", "gripper", "link_4", "finger_l"),
        ("mimic", "gripper_sub", "link_4", "finger_r"),
        ("fixed", "end_effector_joint", "link_4", "end_effector_link"),
    ]
    found = _one(_robot(*_chain("", "world", 4), *fingers))

    assert found.gripper is not None
    assert (found.tip_link, found.gripper.parent_link) == ("end_effector_link", "link_4")
    assert found.gripper.joints == ("gripper", "gripper_sub")


def test_a_robot_without_arm_has_no_group() -> None:
    assert find_groups(_robot(*_chain("", "base", 2))).arms == ()
