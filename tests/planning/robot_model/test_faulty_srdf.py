"""What does not fit the robot is left out with a sentence that lists what there is."""

import pytest
from tests.planning.arms import read_arm

from trundle.base.diagnostics import DescriptionError
from trundle.planning.robot_model import robot_model

_FAULTS = {
    '<group name="a"><joint name="innr"/></group>': "no joint 'innr' (did you mean 'inner'?); there are: 'ASSUMED",
    '<group name="a"><link name="x"/></group>': "no link 'x'; there are: 'base_link', 'inner_arm', 'outer_arm'",
    '<group name="a"/>': "group 'a' has no joints; it is left out",
    '<group><joint name="inner"/></group>': "<group> needs the attribute 'name'; it is left out",
    '<group name="arm"><joint name="inner"/></group>': "a second group 'arm'; the first, at robot_description_sem",
    '<group name="a"><chain base_link="tool" tip_link="tool"/></group>': "the chain from 'tool' to 'tool' has no joint",
    '<group name="a"><chain base_link="tool"/></group>': "<chain> needs the attribute 'tip_link'",
    '<group name="a"><chain base_link="z" tip_link="tool"/></group>': "group 'a': no link 'z'; there are:",
    '<group name="a"><group name="b"/></group>': "group 'a': no subgroup 'b'; there are: 'arm', 'a'",
    '<group name="a"><group name="a"/><joint name="turn"/></group>': "group 'a': its subgroup 'a' contains it",
    '<group_state name="s" group="leg"/>': "group_state 's': no group 'leg'; there are: 'arm'",
    '<group_state name="s"/>': "<group_state> needs the attribute 'group'",
    '<group_state name="s" group="arm"><joint name="k" value="0"/></group_state>': "group 'arm' has no joint 'k'",
    '<group_state name="s" group="arm"><joint name="turn" value="x"/></group_state>': "'x' of joint 'turn' is not one",
    '<group_state name="s" group="arm"><joint name="turn" value="nan"/></group_state>': "'nan' of joint 'turn' is not",
    '<group_state name="s" group="arm"><joint name="turn" value="1 2"/></group_state>': "2 values of joint 'turn', w",
    '<end_effector name="e" group="g" parent_link="tool"/>': "end_effector 'e': no group 'g'; there are: 'arm'",
    '<end_effector name="e" group="arm" parent_link="t"/>': "end_effector 'e': no link 't'; there are:",
    '<end_effector name="e" group="arm" parent_link="tool" parent_group="q"/>': "no parent_group 'q'; there are: 'arm'",
    '<virtual_joint name="v" type="ball" parent_frame="w" child_link="base_link"/>': "no type 'ball'; types: fixed, pl",
    '<virtual_joint name="v" type="fixed" parent_frame="w" child_link="tool"/>': "its child_link is 'tool', not th",
    '<virtual_joint name="turn" type="fixed" parent_frame="w" child_link="base_link"/>': "a joint of the URDF has its",
    '<passive_joint name="t"/>': "passive_joint: no joint 't'; there are:",
    '<joint_property joint_name="t" property_name="a" value="b"/>': "joint_property: no joint 't'; there are:",
    '<disable_collisions link1="a" link2="tool"/>': "collisions of links: no link 'a'; there are: 'base_link'",
    '<disable_default_collisions link="a"/>': "collisions of links: no link 'a'; there are: 'base_link'",
    '<enable_collisions link1="tool"/>': "<enable_collisions> needs the attribute 'link2'",
    "<grup/>": "<grup> in <robot> is not supported; it is ignored",
}


@pytest.mark.parametrize("element", _FAULTS)
def test_a_faulty_element_is_left_out(element: str) -> None:
    _, report = read_arm("scara", srdf=element)

    assert any(_FAULTS[element] in warning for warning in report.warnings), report.warnings
    assert len(report.warnings) <= 2


@pytest.mark.parametrize(
    ("limits", "fault"),
    [
        ({"joint_limits": 3}, "joint_limits is 3, not a list of joints"),
        ({"iner": {}}, "no joint 'iner' (did you mean 'inner'?); there are: 'inner', 'outer'"),
        ({"inner": [1]}, "the limits of joint 'inner' are [1], not has_velocity_limits"),
        ({"inner": {"max_speed": 1}}, "joint 'inner': no limit 'max_speed'; there are: 'has_position_limits'"),
        ({"inner": {"has_velocity_limits": True}}, "joint 'inner': has_velocity_limits, but no max_velocity"),
        ({"inner": {"has_velocity_limits": True, "max_velocity": "a"}}, "max_velocity is 'a', not a number within"),
        ({"inner": {"has_velocity_limits": True, "max_velocity": -1}}, "max_velocity is -1, less than 0"),
        (
            {"inner": {"has_position_limits": True, "min_position": 2, "max_position": 1}},
            "min_position 2 is above max_position 1; the URDF's limits are used",
        ),
    ],
)
def test_faulty_limits_leave_the_urdfs(limits: dict[str, object], fault: str) -> None:
    model, report = read_arm("scara", limits=limits)

    assert len(report.warnings) == 1
    assert fault in report.warnings[0]
    assert (model.lower[0], model.upper[0], model.max_velocity[0]) == (-2.4, 2.4, 2.0)


@pytest.mark.parametrize("mimic", ["nobody", "right_finger_joint", "hand_joint"])
def test_a_faulty_mimic_moves_on_its_own(mimic: str) -> None:
    model, report = read_arm("six_axis", ('<mimic joint="left_finger_joint"/>', f'<mimic joint="{mimic}"/>'))

    assert model.group("gripper").joints == ("left_finger_joint", "right_finger_joint")
    assert "joint 'right_finger_joint' is no mimic: " in report.warnings[0]


def test_groups_that_contain_each_other_are_read() -> None:
    more = """
<group name="a"><group name="b"/><joint name="turn"/></group>
<group name="b"><group name="a"/><joint name="lift"/></group>"""
    model, report = read_arm("scara", srdf=more)

    assert model.group("a").joints == ("lift", "turn")
    assert model.group("b").joints == ("lift",)
    assert len(report.warnings) == 1


def test_pairs_of_links_are_limited() -> None:
    links = "".join(f"<link name='l{i}'/>" for i in range(1200))
    joints = "".join(
        f"<joint name='j{i}' type='fixed'><parent link='l0'/><child link='l{i}'/></joint>" for i in range(1, 1200)
    )
    srdf = "".join(f"<disable_default_collisions link='l{i}'/>" for i in range(1200))

    with pytest.raises(DescriptionError, match="for 1200 of 1200 links; at most 1000000 pairs"):
        robot_model(f"<robot name='r'>{links}{joints}</robot>", f"<robot name='r'>{srdf}</robot>")
