"""A model has MoveIt's joints, variables, groups and states."""

import math

import numpy as np
import pytest
from tests.planning.arms import ARMS, arm, changed_arm, read_arm

from trundle.base.diagnostics import DescriptionError, Diagnostics, UsageError
from trundle.planning.robot_model import robot_model


def _planar(kind: str) -> str:
    return f'<virtual_joint name="base" type="{kind}" parent_frame="odom" child_link="base_link"/>'


_FIXED = '<virtual_joint name="fixed_base" type="fixed" parent_frame="world" child_link="base_link"/>'


@pytest.mark.parametrize("name", ARMS)
def test_an_arm_is_a_chain(name: str) -> None:
    model = arm(name)
    group = model.group("arm")

    assert group.is_chain
    assert len(group.tips) == 1
    assert model.joints[0].child_link == model.root_link
    assert {joint.parent_link for joint in model.joints[1:]} <= set(model.links)


def test_groups_of_chains_joints_links_and_subgroups() -> None:
    model = arm("six_axis")
    arm_group, gripper, both = (model.group(name) for name in ("arm", "gripper", "arm_with_gripper"))

    assert arm_group.joints == tuple(f"joint_{i}" for i in range(1, 7))
    assert arm_group.all_joints == (*arm_group.joints, "tool_joint")
    assert (arm_group.base, arm_group.tips) == ("base_link", ("tool0",))
    assert arm_group.updated_links[-3:] == ("hand", "left_finger", "right_finger")
    assert gripper.joints == gripper.variables == ("left_finger_joint",)
    assert gripper.all_variables == ("left_finger_joint", "right_finger_joint")
    assert (gripper.base, gripper.tips, gripper.is_chain) == ("tool0", ("left_finger", "right_finger"), False)
    assert both.joints == (*arm_group.joints, *gripper.joints)
    assert both.subgroups == ("arm", "gripper")


def test_a_group_with_a_gap_has_one_tip() -> None:
    """As the groups of xarm_ros, which list each joint but the one to the flange."""
    listed = "".join(f'<joint name="joint_{i}"/>' for i in range(1, 7)) + '<joint name="hand_joint"/>'
    group = changed_arm("six_axis", srdf=f'<group name="gap">{listed}</group>').group("gap")

    assert (group.tips, group.is_chain) == (("hand",), True)


def test_end_effectors_are_attached_to_the_group_that_moves_them() -> None:
    model = arm("six_axis")

    assert model.end_effectors["gripper"].parent_group == "arm"
    assert model.group("gripper").end_effector == model.end_effectors["gripper"]
    assert model.group("arm").attached_end_effectors == ("gripper",)
    assert model.group("arm_with_gripper").attached_end_effectors == ("gripper",)  # it has the parent link, too
    assert arm("four_axis").end_effectors["jaw"].parent_group == "arm"  # not named in the file


def test_an_end_effector_may_share_its_parent_link_with_the_arm() -> None:
    """As in the SRDF of Pi Robot, whose arm's chain ends at a link of the gripper."""
    shared = '<group name="hand"><link name="tool0"/><link name="left_finger"/></group>'
    shared += '<end_effector name="fingers" parent_link="tool0" group="hand"/>'

    model = changed_arm("six_axis", srdf=shared)

    assert model.end_effectors["fingers"].parent_group == "arm"
    assert "fingers" in model.group("arm").attached_end_effectors


def test_variables_are_ordered_depth_first_and_by_name() -> None:
    model = arm("six_axis")

    assert model.variables == (*(f"joint_{i}" for i in range(1, 7)), "left_finger_joint", "right_finger_joint")
    assert model.variable_index("joint_3") == 2
    with pytest.raises(UsageError, match=r"no variable 'joint3' \(did you mean 'joint_3'\?\); there are: 'joint_1'"):
        model.variable_index("joint3")


def test_states_hold_mimic_joints_and_defaults() -> None:
    model = arm("six_axis")
    state = model.state_of(model.group("gripper").default_states["open"])

    assert list(state[-2:]) == [0.04, 0.04]
    assert model.with_mimics(np.full((3, 8), 0.02))[:, -1].tolist() == [0.02] * 3
    off_zero = changed_arm("six_axis", ('lower="-2.4" upper="1.2"', 'lower="-2.4" upper="-1.2"'))
    assert off_zero.default_positions()[2] == pytest.approx(-1.8)
    assert not off_zero.is_within_bounds(np.zeros(8))
    assert off_zero.is_within_bounds(off_zero.default_positions())


def test_a_joint_without_end_has_no_bounds() -> None:
    model = arm("seven_axis")

    assert (model.lower[4], model.upper[4]) == (-math.pi, math.pi)
    assert model.is_bounded.tolist() == [True] * 4 + [False, True, False]
    assert model.is_within_bounds(np.array([0, 0, 0, 0, 50.0, 0, -9.0]))


@pytest.mark.parametrize(
    ("kind", "frame", "variables"),
    [
        ("fixed", "base_link", ()),
        ("planar", "odom", ("base/x", "base/y", "base/theta")),
        (
            "floating",
            "odom",
            tuple(f"base/{n}" for n in ["trans_x", "trans_y", "trans_z", "rot_x", "rot_y", "rot_z", "rot_w"]),
        ),
    ],
)
def test_virtual_joints_move_the_root(kind: str, frame: str, variables: tuple[str, ...]) -> None:
    model = changed_arm("six_axis", (_FIXED, _planar(kind)))

    assert model.joints[0].variables == variables
    assert model.model_frame == frame
    assert model.variables[: len(variables)] == variables
    assert sum(model.default_positions()) == (kind == "floating")  # the quaternion's w


def test_joint_limits_win_over_the_urdf() -> None:
    limits = {
        "default_velocity_scaling_factor": 0.1,
        "joint_limits": {
            "joint_1": {"has_velocity_limits": True, "max_velocity": 1.5, "has_acceleration_limits": False},
            "joint_2": {"has_acceleration_limits": True, "max_acceleration": 4, "max_velocity": 0.1},
            "joint_3": {"has_position_limits": True, "min_position": -1.0, "max_position": 1.0},
        },
    }
    model = changed_arm("six_axis", limits=limits)

    assert model.max_velocity[:3].tolist() == [1.5, 2.0, 2.0]
    assert model.max_acceleration[:3].tolist() == [math.inf, 4.0, math.inf]
    assert (model.lower[2], model.upper[2]) == (-1.0, 1.0)


def test_soft_limits_narrow_a_joint() -> None:
    soft = '<safety_controller k_velocity="1" soft_lower_limit="-1" soft_upper_limit="9"/></joint>'
    urdf = f"""
<robot name="one"><link name="a"/><link name="b"/>
  <joint name="j" type="revolute"><parent link="a"/><child link="b"/><limit effort="1" velocity="-2" lower="-2"
    upper="2"/>{soft}
</robot>"""
    joint = robot_model(urdf).joint("j")

    assert (joint.lower, joint.upper, joint.max_velocity) == ((-1.0,), (2.0,), (2.0,))


def test_a_chain_may_go_up_and_down() -> None:
    chain = '<chain base_link="left_finger" tip_link="wrist_3"/>'
    model, _ = read_arm("six_axis", ('<chain base_link="base_link" tip_link="tool0"/>', chain))
    group = model.group("arm")

    assert group.all_joints == ("tool_joint", "hand_joint", "left_finger_joint")


def test_collisions_are_disabled_by_pair_or_by_link() -> None:
    pairs = arm("six_axis").disabled_pairs
    first = '<disable_collisions link1="base_link" link2="shoulder" reason="Adjacent"/>'
    hand_only = first + '<disable_default_collisions link="hand"/><enable_collisions link1="hand" link2="shoulder"/>'
    by_link = changed_arm("six_axis", (first, hand_only)).disabled_pairs

    assert frozenset(("base_link", "shoulder")) in pairs
    assert frozenset(("hand", "shoulder")) not in pairs | by_link
    assert frozenset(("hand", "base_link")) in by_link - pairs


def test_passive_joints_properties_and_spheres() -> None:
    more = """
  <passive_joint name="turn"/>
  <joint_property joint_name="inner" property_name="motion_model" value="holonomic"/>
  <link_sphere_approximation link="hand"><sphere center="0 0 0" radius="1"/></link_sphere_approximation>"""
    model, report = read_arm("scara", srdf=more)

    assert [joint.name for joint in model.joints if joint.passive] == ["turn"]
    assert model.joint("inner").properties == {"motion_model": "holonomic"}
    assert [finding.severity for finding in report.findings] == ["info"]


def test_mimics_of_mimics_follow_the_first() -> None:
    third = """
  <link name="third"/>
  <joint name="a_third" type="prismatic"><parent link="hand"/><child link="third"/><limit effort="1" velocity="1"/>
    <mimic joint="right_finger_joint" multiplier="-2" offset="0.5"/></joint>
</robot>"""
    text = (
        ("</robot>\n", third),
        ('<mimic joint="left_finger_joint"/>', '<mimic joint="left_finger_joint" offset="1"/>'),
    )
    model, _ = read_arm("six_axis", *text)

    assert model.joint("a_third").mimic == ("left_finger_joint", -2.0, -1.5)


def test_an_srdf_of_another_robot_is_used_with_a_warning() -> None:
    report = Diagnostics()
    model = robot_model("<robot name='a'><link name='l'/></robot>", "<robot name='b'/>", None, report)

    assert model.groups == {}
    assert report.warnings == [
        "robot_description_semantic:1: warning: the SRDF is of robot 'b', the URDF of 'a'; it is used"
    ]


def test_a_text_that_is_no_srdf_is_an_error() -> None:
    with pytest.raises(DescriptionError, match="an SRDF starts with <robot>, not <sdf>"):
        robot_model("<robot name='a'><link name='l'/></robot>", "<sdf/>")
