"""Inverse kinematics reaches what forward kinematics reached, within limits, and the same way each time."""

import threading
from typing import Literal

import numpy as np
import pytest
from tests.planning.arms import ARMS, arm, changed_arm

from trundle.base.diagnostics import UsageError
from trundle.planning.kinematics import InverseKinematics, Kinematics, KinematicsSettings
from trundle.planning.robot_model import RobotModel
from trundle.spatial import Pose

_PAIRED = "arm_with_gripper"


def _random_state(model: RobotModel, rng: np.random.Generator) -> np.ndarray:
    return model.with_mimics(rng.uniform(model.lower, model.upper))


def _pose(model: RobotModel, state: np.ndarray, link: str) -> np.ndarray:
    return Kinematics(model).link_poses(state)[model.links.index(link)]


def _distance(a: np.ndarray, b: np.ndarray) -> tuple[float, float]:
    """Return distance [m] and angle [rad] of two poses."""
    return float(np.linalg.norm(a[:3] - b[:3])), 2 * float(np.arccos(min(1.0, abs(a[3:] @ b[3:]))))


@pytest.mark.parametrize("name", ARMS)
def test_reachable_poses_are_reached(name: str) -> None:
    model, rng = arm(name), np.random.default_rng(3)
    solver = InverseKinematics(model, "arm")
    for _ in range(200):
        pose = _pose(model, _random_state(model, rng), solver.tip)
        state = solver.solve(pose, _random_state(model, rng))
        assert state is not None
        assert model.is_within_bounds(state)
        far, turned = _distance(_pose(model, state, solver.tip), pose)
        assert far < 1e-5 * 3**0.5
        assert turned < 1e-5 * 3**0.5 + 3e-8  # arccos has half the digits


def test_the_same_request_has_the_same_answer() -> None:
    model, rng = arm("seven_axis"), np.random.default_rng(5)
    pose, seed = _pose(model, _random_state(model, rng), "flange"), _random_state(model, rng)
    first, *others = [InverseKinematics(model, "arm").search(pose, seed) for _ in range(3)]

    assert all(np.array_equal(first.positions, other.positions) for other in others)
    assert first.iterations == others[0].iterations


def test_a_solution_is_close_to_the_seed() -> None:
    """From a seed nearby, no joint turns the long way, and whole turns of joint_6 and joint_7 are taken off."""
    for name in ("six_axis", "seven_axis"):
        model, rng = arm(name), np.random.default_rng(11)
        solver = InverseKinematics(model, "arm")
        for _ in range(50):
            state = 0.8 * _random_state(model, rng)
            seed = state + rng.uniform(-0.02, 0.02, state.shape)
            seed[model.variable_index("joint_5")] += 1e-3
            found = solver.search(_pose(model, state, solver.tip), seed)
            assert found.is_found
            if found.attempts == 1:
                assert np.abs(found.positions - seed).max() < 1.0


def test_whole_turns_are_taken_off() -> None:
    model = changed_arm("six_axis", ('lower="-6.2" upper="6.2"', 'lower="-12.5" upper="12.5"'))
    state = model.state_of({"joint_3": -0.5, "joint_5": 0.7, "joint_6": 0.3})
    seed = model.state_of({"joint_3": -0.45, "joint_5": 0.6, "joint_6": 0.3 + 2 * np.pi})
    found = InverseKinematics(model, "arm").solve(_pose(model, state, "tool0"), seed)

    assert found is not None
    assert found[model.variable_index("joint_6")] == pytest.approx(0.3 + 2 * np.pi, abs=1e-4)


def test_distance_finds_the_nearest_of_eight() -> None:
    model, rng = arm("six_axis"), np.random.default_rng(2)
    speed, near = (
        InverseKinematics(model, "arm", settings=KinematicsSettings(solve_type=kind, timeout=0.1))
        for kind in ("Speed", "Distance")
    )
    lengths: list[list[float]] = [[], []]
    for _ in range(20):
        pose, seed = _pose(model, _random_state(model, rng), "tool0"), _random_state(model, rng)
        for solver, found in zip((speed, near), lengths, strict=True):
            state = solver.solve(pose, seed)
            assert state is not None
            found.append(float(np.linalg.norm(state - seed)))
    assert all(near <= first + 1e-9 for first, near in zip(*lengths, strict=True))
    assert sum(lengths[1]) < 0.95 * sum(lengths[0])


@pytest.mark.parametrize(("kind", "index"), [("Manip1", 0), ("Manip2", 1)])
def test_manip_prefers_states_far_from_singularities(kind: Literal["Manip1", "Manip2"], index: int) -> None:
    model, rng = arm("seven_axis"), np.random.default_rng(2)
    kinematics = Kinematics(model)
    solvers = [
        InverseKinematics(kinematics, "arm", settings=settings)
        for settings in (KinematicsSettings(), KinematicsSettings(solve_type=kind))
    ]
    values: list[list[float]] = [[], []]
    for _ in range(10):
        pose, seed = _pose(model, _random_state(model, rng), "flange"), _random_state(model, rng)
        for solver, found in zip(solvers, values, strict=True):
            state = solver.solve(pose, seed)
            assert state is not None
            measures = (kinematics.manipulability("arm", state), 1 / kinematics.singularity("arm", state))
            found.append(measures[index])
    assert all(best >= first - 1e-9 for first, best in zip(*values, strict=True))
    assert sum(values[1]) > 1.02 * sum(values[0])


def test_position_only_leaves_the_rotation_free() -> None:
    model = arm("four_axis")
    state = model.state_of({"turn": 0.5, "shoulder": 0.3, "elbow": -0.4})
    pose = _pose(model, state, "grip_center")
    pose[3:] = [1.0, 0.0, 0.0, 0.0]
    whole = InverseKinematics(model, "arm").search(pose, model.default_positions(), timeout=0.01)
    free = InverseKinematics(model, "arm", settings=KinematicsSettings(position_only=True))
    found = free.solve(pose, model.default_positions())

    assert not whole.is_found  # four joints turn the tip about two axes only
    assert found is not None
    assert _pose(model, found, "grip_center")[:3] == pytest.approx(pose[:3], abs=2e-5)


def test_what_cannot_be_reached_is_not_found() -> None:
    solver = InverseKinematics(arm("six_axis"), "arm")
    found = solver.search(Pose((3.0, 0.0, 0.5)), solver.model.default_positions(), timeout=0.01)

    assert solver.solve(Pose((3.0, 0.0, 0.5)), solver.model.default_positions(), timeout=0.01) is None
    assert found.attempts > 10
    assert 4000 <= found.iterations < 4100
    assert 1.5 < found.position_error < 3.0  # stretched towards it
    assert solver.search(Pose((3.0, 0.0, 0.5)), solver.model.default_positions(), timeout=-1.0).attempts == 1


def test_a_check_refuses_solutions() -> None:
    model = arm("six_axis")
    solver = InverseKinematics(model, "arm")
    state = model.state_of({"joint_2": 0.3, "joint_3": -0.4, "joint_4": 0.5, "joint_5": 0.7})
    asked: list[np.ndarray] = []

    def wrist_flipped(positions: np.ndarray) -> bool:
        asked.append(positions)
        return bool(positions[model.variable_index("joint_5")] < 0)

    found = solver.search(_pose(model, state, "tool0"), state, valid=wrist_flipped)

    assert found.is_found
    assert found.positions[model.variable_index("joint_5")] < 0
    assert found.refused == len(asked) - 1 >= 1
    assert asked[0] == pytest.approx(state)
    assert not solver.search(_pose(model, state, "tool0"), state, valid=lambda _: False, timeout=0.01).is_found


def test_an_error_of_a_check_is_raised() -> None:
    model = arm("six_axis")

    def broken(positions: np.ndarray) -> bool:
        raise KeyError("scene")

    with pytest.raises(KeyError, match="scene"):
        InverseKinematics(model, "arm").solve(
            _pose(model, model.default_positions(), "tool0"), model.default_positions(), valid=broken
        )


def test_consistency_keeps_a_solution_near_the_seed() -> None:
    model, rng = arm("six_axis"), np.random.default_rng(8)
    solver = InverseKinematics(model, "arm")
    found = 0
    for _ in range(40):
        pose, seed = _pose(model, _random_state(model, rng), "tool0"), _random_state(model, rng)
        state = solver.solve(pose, seed, consistency=[1.5] * 6, timeout=0.005)
        if state is not None:
            found += 1
            assert np.abs(state - seed).max() <= 1.5
    assert 0 < found < 40


def test_mimic_joints_and_frames_below_the_tip() -> None:
    model, rng = arm("six_axis"), np.random.default_rng(4)
    offset = Pose.from_rpy(0.0, 0.02, 0.1, 0.3)
    solver = InverseKinematics(model, _PAIRED, "right_finger", link_from_tip=offset)
    kinematics = Kinematics(model)
    for _ in range(20):
        pose = kinematics.link_pose(_random_state(model, rng), "right_finger") @ offset
        state = solver.solve(pose, _random_state(model, rng))
        assert state is not None
        assert state[-1] == state[-2]
        reached = kinematics.link_pose(state, "right_finger") @ offset
        assert reached.position == pytest.approx(pose.position, abs=2e-5)


def test_a_base_that_drives_is_part_of_a_group() -> None:
    planar = '<virtual_joint name="base" type="planar" parent_frame="odom" child_link="base_link"/>'
    fixed = '<virtual_joint name="fixed_base" type="fixed" parent_frame="world" child_link="base_link"/>'
    whole = '<group name="whole"><joint name="base"/><group name="arm"/></group>'
    model = changed_arm("six_axis", (fixed, planar), srdf=whole)
    bent = model.state_of({"joint_2": 0.3, "joint_3": -0.4, "joint_5": 0.7})
    far = Pose((3.6, 3.0, 0.0)) @ Kinematics(model).link_pose(bent, "tool0")

    standing = InverseKinematics(model, "arm").search(far, model.default_positions(), timeout=0.01)
    driving = InverseKinematics(model, "whole").solve(far, model.default_positions())
    assert not standing.is_found
    assert driving is not None
    assert Kinematics(model).link_pose(driving, "tool0").position == pytest.approx(far.position, abs=2e-5)
    moved = model.state_of({"base/x": 3.6, "base/y": 3.0})  # the arm's poses are in the model's frame
    assert InverseKinematics(model, "arm").solve(far, moved) is not None


def test_other_threads_run_while_a_pose_is_sought() -> None:
    solver = InverseKinematics(arm("six_axis"), "arm")
    counted, done = 0, threading.Event()

    def search() -> None:
        solver.search(Pose((3.0, 0.0, 0.5)), solver.model.default_positions(), timeout=0.1)
        done.set()

    thread = threading.Thread(target=search)
    thread.start()
    while not done.wait(0.001):
        counted += 1
    thread.join()
    assert counted > 3


@pytest.mark.parametrize(
    ("pose", "seed", "message"),
    [
        ([0.0] * 7, [0.0] * 8, "the quaternion of a pose is not zero"),
        ([np.nan, 0, 0, 0, 0, 0, 1], [0.0] * 8, "a pose is finite"),
        ([0.0, 0, 0], [0.0] * 8, "a pose is x, y, z, qx, qy, qz, qw"),
        ([0.0, 0, 0, 0, 0, 0, 1], [0.0] * 6, "a state holds every variable"),
    ],
)
def test_impossible_requests_are_named(pose: list[float], seed: list[float], message: str) -> None:
    solver = InverseKinematics(arm("six_axis"), "arm")

    with pytest.raises(UsageError, match=message):
        solver.solve(pose, np.array(seed))
    with pytest.raises(UsageError, match="a tolerance for each variable"):
        solver.solve(Pose(), solver.model.default_positions(), consistency=[1.0])


def test_a_seed_that_is_not_finite_or_outside_the_limits_is_a_start() -> None:
    model = arm("six_axis")
    solver = InverseKinematics(model, "arm")
    pose = _pose(model, model.state_of({"joint_3": -0.3, "joint_5": 0.5}), "tool0")

    for value in (np.nan, np.inf, 1e300, -40.0):
        seed = model.default_positions()
        seed[2] = value
        state = solver.solve(pose, seed)
        assert state is not None
        assert model.is_within_bounds(state)
