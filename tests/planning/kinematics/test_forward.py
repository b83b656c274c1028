"""Poses and Jacobians are those of the URDF."""

import numpy as np
import pytest
from tests.planning.arms import ARMS, arm, changed_arm

from trundle.base.diagnostics import UsageError
from trundle.planning.kinematics import Kinematics
from trundle.planning.kinematics.forward import pose_row
from trundle.planning.robot_model import RobotModel
from trundle.robots.robot import root_from_links
from trundle.spatial import quaternion_product

_FIXED = '<virtual_joint name="fixed_base" type="fixed" parent_frame="world" child_link="base_link"/>'


def _moving(kind: str) -> RobotModel:
    joint = f'<virtual_joint name="base" type="{kind}" parent_frame="odom" child_link="base_link"/>'
    return changed_arm("six_axis", (_FIXED, joint))


def _random_states(model: RobotModel, count: int) -> np.ndarray:
    rng = np.random.default_rng(7)
    return model.with_mimics(
        rng.uniform(np.maximum(model.lower, -4), np.minimum(model.upper, 4), size=(count, len(model.variables)))
    )


@pytest.mark.parametrize("name", ARMS)
def test_link_poses_are_those_of_the_urdf(name: str) -> None:
    model = arm(name)
    states = _random_states(model, 20)
    poses = Kinematics(model).link_poses(states)

    for state, rows in zip(states, poses, strict=True):
        expected = root_from_links(model.urdf, dict(zip(model.variables, state, strict=True)))
        for link, row in zip(model.links, rows, strict=True):
            truth = np.array(pose_row(expected[link]))
            assert row[:3] == pytest.approx(truth[:3], abs=1e-12)
            assert abs(row[3:] @ truth[3:]) == pytest.approx(1.0, abs=1e-12)


def test_a_planar_joint_moves_and_turns_the_root() -> None:
    model = _moving("planar")
    kinematics = Kinematics(model)
    state = model.state_of({"base/x": 1.0, "base/y": 2.0, "base/theta": np.pi / 2})

    pose = kinematics.link_pose(state, "base_link")
    assert pose.position == pytest.approx((1, 2, 0))
    assert pose.rpy == pytest.approx((0, 0, np.pi / 2))
    at_root = kinematics.link_pose(model.default_positions(), "tool0")
    assert kinematics.link_pose(state, "tool0").position == pytest.approx((pose @ at_root).position)


def test_a_floating_joint_holds_a_pose() -> None:
    model = _moving("floating")
    names = [f"base/{name}" for name in ("trans_x", "trans_y", "trans_z", "rot_x", "rot_y", "rot_z", "rot_w")]
    values = [1.0, 2.0, 3.0, 0.0, 0.6, 0.0, 0.8]
    row = Kinematics(model).link_poses(model.state_of(dict(zip(names, values, strict=True))))[0]

    assert row == pytest.approx(values)


@pytest.mark.parametrize("name", ARMS)
def test_a_jacobian_is_the_derivative_of_the_pose(name: str) -> None:
    _compare_with_differences(arm(name), "arm", None)


def test_a_jacobian_contains_mimic_joints_and_the_base() -> None:
    _compare_with_differences(arm("six_axis"), "arm_with_gripper", "right_finger")
    _compare_with_differences(_moving("planar"), "arm_with_gripper", "right_finger")


def _compare_with_differences(model: RobotModel, group: str, tip: str | None) -> None:
    """Central differences have an error of the step's square."""
    kinematics, step = Kinematics(model), 1e-5
    link = model.links.index(tip or model.group(group).tips[0])
    for state in _random_states(model, 5):
        jacobian = kinematics.jacobian(group, state, tip)
        for column, variable in zip(jacobian.T, model.group(group).variables, strict=True):
            rows = []
            for sign in (1, -1):
                moved = state.copy()
                moved[model.variable_index(variable)] += sign * step
                rows.append(kinematics.link_poses(model.with_mimics(moved))[link])
            linear = (rows[0][:3] - rows[1][:3]) / (2 * step)
            w, *xyz = quaternion_product(_wxyz(rows[0]), _wxyz(rows[1] * [1, 1, 1, -1, -1, -1, 1]))
            angular = np.array(xyz) * np.sign(w) / step
            assert column == pytest.approx([*linear, *angular], abs=1e-8)


def _wxyz(row: np.ndarray) -> tuple[float, float, float, float]:
    x, y, z, w = row[3:].tolist()
    return (w, x, y, z)


def test_manipulability_vanishes_in_a_singularity() -> None:
    model = arm("six_axis")
    kinematics = Kinematics(model)
    bent = model.state_of({"joint_3": -1.0, "joint_5": 0.8})
    rows = kinematics.jacobian("arm", bent)

    assert kinematics.manipulability("arm", bent) == pytest.approx(abs(np.linalg.det(rows)))
    assert kinematics.singularity("arm", bent) == pytest.approx(np.linalg.cond(rows))
    straight = model.state_of({"joint_5": 0.0})  # axes 4 and 6 are one line
    assert kinematics.manipulability("arm", straight) == pytest.approx(0.0, abs=1e-9)
    assert kinematics.singularity("arm", straight) > 1e7
    four = arm("four_axis")
    state = four.state_of({"elbow": 0.7})
    singular = np.linalg.svd(Kinematics(four).jacobian("arm", state), compute_uv=False)
    assert Kinematics(four).manipulability("arm", state) == pytest.approx(np.prod(singular))


def test_unknown_names_are_told_apart() -> None:
    kinematics = Kinematics(arm("six_axis"))
    state = kinematics.model.default_positions()

    with pytest.raises(UsageError, match=r"no link 'tool' \(did you mean 'tool0'\?\); there are: 'base_link'"):
        kinematics.jacobian("arm", state, "tool")
    with pytest.raises(UsageError, match="no group 'legs'; there are: 'arm', 'gripper'"):
        kinematics.jacobian("legs", state)
    with pytest.raises(UsageError, match="group 'gripper' has no single tip; name one of 'hand', 'left_finger'"):
        kinematics.jacobian("gripper", state)
    with pytest.raises(UsageError, match="'gripper' and link 'tool0': no variable of the group moves the tip"):
        kinematics.jacobian("gripper", state, "tool0")
    with pytest.raises(UsageError, match="no link 'x'"):
        kinematics.link_pose(state, "x")
