"""Execution by controllers: fake ones, actions, and what stops a motion."""

from typing import Any

import numpy as np
import pytest
from tests.planning.move_group.arm_graph import ARM, add, box, joint_goal, request, send, start_arm

from trundle.planning.move_group.controllers import path_from_message, path_message
from trundle.planning.move_group.settings import read_settings
from trundle.planning.move_group.trajectory_execution import ExecutionSettings
from trundle.robots.parameters import RosParameters
from trundle.ros import ActionResult, ActionServer, Messages

_HOME = [0.0, 0.0, 0.0, 0.0, 0.8, 0.0]
_CONTROL_FAILED, _PREEMPTED, _CHANGED = -4, -7, -3
_EXECUTE = "moveit_msgs/ExecuteTrajectory"


def _trajectory(*points: list[float], seconds: float = 0.2, joints: list[str] = ARM) -> dict[str, Any]:
    rows = [
        {"positions": positions, "time_from_start": round(index * seconds * 1e9)}
        for index, positions in enumerate(points)
    ]
    return {"joint_trajectory": {"joint_names": joints, "points": rows}}


@pytest.mark.parametrize("kind", ["interpolate", "via points", "last point"])
def test_fake_controllers_publish_states_along_the_trajectory(kind: str, graph: Any) -> None:
    start_arm(graph, kind=kind)
    states = graph.listen("/move_group/fake_controller_joint_states", "sensor_msgs/JointState")
    graph.until(lambda: graph.connected("/move_group/fake_controller_joint_states"))
    end = [0.2, *_HOME[1:]]

    result = send(graph, "execute_trajectory", _EXECUTE, {"trajectory": _trajectory(_HOME, [0.1, *_HOME[1:]], end)})

    assert result.result.error_code.val == 1
    moved = [m.position[0] for m in states if list(m.name) == ARM]
    assert moved[-1] == 0.2
    if kind == "last point":
        assert moved == [0.2]
    elif kind == "via points":
        assert 0.1 in moved
    else:
        assert len(moved) > 5


def test_a_trajectory_that_begins_elsewhere_is_refused(graph: Any) -> None:
    start_arm(graph)

    result = send(graph, "execute_trajectory", _EXECUTE, {"trajectory": _trajectory([0.5] * 6, [0.6] * 6)})

    assert result.result.error_code.val == _CONTROL_FAILED


@pytest.mark.parametrize(("trajectory", "code"), [({}, _CONTROL_FAILED), (_trajectory(), 1)], ids=["none", "no points"])
def test_an_empty_trajectory_ends_at_once(graph: Any, trajectory: dict[str, Any], code: int) -> None:
    """A program that executes a plan that was not found has an answer, as from MoveIt."""
    start_arm(graph)

    assert send(graph, "execute_trajectory", _EXECUTE, {"trajectory": trajectory}).result.error_code.val == code


def test_joints_without_a_controller_are_named(graph: Any, capfd: pytest.CaptureFixture[str]) -> None:
    start_arm(graph, controller_list=[{"name": "half", "type": "interpolate", "joints": ARM[:3]}])

    result = send(graph, "execute_trajectory", _EXECUTE, {"trajectory": _trajectory(_HOME, [0.1, *_HOME[1:]])})

    assert result.result.error_code.val == _CONTROL_FAILED
    assert "nothing moves joint_4, joint_5, joint_6" in capfd.readouterr().err


def test_the_event_stop_ends_a_motion(graph: Any) -> None:
    start_arm(graph)
    results = graph.listen("/execute_trajectory/result", f"{_EXECUTE}ActionResult")
    goals = graph.advertise("/execute_trajectory/goal", f"{_EXECUTE}ActionGoal")
    events = graph.advertise("/trajectory_execution_event", "std_msgs/String")
    states = graph.listen("/move_group/fake_controller_joint_states", "sensor_msgs/JointState")
    graph.until(lambda: graph.connected("/execute_trajectory/result"))

    goals.publish({"goal": {"trajectory": _trajectory(_HOME, [1.0, *_HOME[1:]], seconds=60.0)}})
    graph.until(lambda: any(0.0 < m.position[0] < 1.0 for m in states if list(m.name) == ARM))
    events.publish({"data": "stop"})
    graph.until(lambda: results)

    assert results[0].result.error_code.val == _PREEMPTED


def test_a_motion_stops_before_an_object_that_appears(graph: Any) -> None:
    start_arm(graph)
    results = graph.listen("/move_group/result", "moveit_msgs/MoveGroupActionResult")
    goals = graph.advertise("/move_group/goal", "moveit_msgs/MoveGroupActionGoal")
    states = graph.listen("/move_group/fake_controller_joint_states", "sensor_msgs/JointState")
    graph.until(lambda: graph.connected("/move_group/result"))
    wanted = request(joint_goal({**dict(zip(ARM, _HOME, strict=True)), "joint_1": 1.5}))

    goals.publish({"goal": {"request": {**wanted, "max_velocity_scaling_factor": 0.05}}})
    graph.until(lambda: any(m.position[0] > 0.0 for m in states if list(m.name) == ARM))
    add(graph, box("wall", 0.0, 0.45, 0.6, (0.1, 0.5, 1.2)))
    graph.until(lambda: results)

    assert results[0].result.error_code.val == _CHANGED


def test_trajectories_are_split_among_actions_of_controllers(graph: Any) -> None:
    """An arm's FollowJointTrajectory and a gripper's GripperCommand get the joints that they move."""
    goals: dict[str, Any] = {}

    def serve(name: str, kind: str) -> None:
        async def work(goal: Any, accept: Any) -> ActionResult:
            accept()
            goals[name] = goal
            return ActionResult(result={})

        ActionServer(graph.client, name, kind, work)

    serve("/arm_controller/follow_joint_trajectory", "control_msgs/FollowJointTrajectory")
    serve("/gripper/gripper_cmd", "control_msgs/GripperCommand")
    listed = [
        {
            "name": "arm_controller",
            "action_ns": "follow_joint_trajectory",
            "type": "FollowJointTrajectory",
            "joints": ARM,
            "goal_tolerance": [{"joint": "joint_1", "position": 0.02}],
        },
        {
            "name": "gripper",
            "action_ns": "gripper_cmd",
            "type": "GripperCommand",
            "joints": ["left_finger_joint"],
            "max_effort": 12.0,
        },
    ]
    manager = "moveit_simple_controller_manager/MoveItSimpleControllerManager"
    zeros = {"joint_5": 0.8, "left_finger_joint": 0.04}
    start_arm(graph, zeros=zeros, controller_list=listed, moveit_controller_manager=manager)
    both = [*ARM, "left_finger_joint"]

    trajectory = _trajectory([*_HOME, 0.04], [0.1, *_HOME[1:], 0.01], joints=both)
    result = send(graph, "execute_trajectory", _EXECUTE, {"trajectory": trajectory})

    assert result.result.error_code.val == 1
    arm = goals["/arm_controller/follow_joint_trajectory"]
    assert list(arm.trajectory.joint_names) == ARM
    assert arm.goal_tolerance[0].name == "joint_1"
    command = goals["/gripper/gripper_cmd"].command
    assert (command.position, command.max_effort) == (0.01, 12.0)


def test_a_controller_may_have_no_name_but_a_namespace(graph: Any) -> None:
    """xArm's: its action is at the node's root, and remapped by launch files."""
    goals: list[Any] = []

    async def work(goal: Any, accept: Any) -> ActionResult:
        accept()
        goals.append(goal)
        return ActionResult(result={})

    ActionServer(graph.client, "/follow_joint_trajectory", "control_msgs/FollowJointTrajectory", work)
    listed = [{"name": "", "action_ns": "follow_joint_trajectory", "type": "FollowJointTrajectory", "joints": ARM}]
    manager = "moveit_simple_controller_manager/MoveItSimpleControllerManager"
    start_arm(graph, zeros={"joint_5": 0.8}, controller_list=listed, moveit_controller_manager=manager)

    result = send(graph, "execute_trajectory", _EXECUTE, {"trajectory": _trajectory(_HOME, [0.1, *_HOME[1:]])})

    assert result.result.error_code.val == 1
    assert list(goals[0].trajectory.joint_names) == ARM


def test_settings_of_execution_are_within_the_bounds_of_its_dynamic_reconfigure() -> None:
    """Crane X7's launch files ask for 0.6 of a trajectory's duration, and MoveIt lets it take the whole."""
    warnings: list[str] = []
    tree = {"allowed_execution_duration_scaling": 0.6, "allowed_goal_duration_margin": 99.0}

    settings = read_settings(ExecutionSettings, RosParameters(tree, "/trajectory_execution", warn=warnings.append))

    assert settings.allowed_execution_duration_scaling == 1.0
    assert settings.allowed_goal_duration_margin == 30.0
    assert "must be ≥ 1, got 0.6" in warnings[0]


def test_a_path_is_the_same_after_a_message() -> None:
    library = Messages()
    points = [{"positions": [0.0, 1.0], "velocities": [0.5, 0.5]}, {"positions": [1.0, 2.0], "velocities": [0.0, 0.0]}]
    points[1]["time_from_start"] = 1_500_000_000  # type: ignore[assignment]
    fields = {"joint_names": ["a", "b"], "points": points}

    path = path_from_message(library.new("trajectory_msgs/JointTrajectory", fields))
    again = path_from_message(library.new("trajectory_msgs/JointTrajectory", path_message(path)))

    assert again.joints == ("a", "b")
    np.testing.assert_array_equal(again.positions, path.positions)
    np.testing.assert_array_equal(path.at(0.75), [0.5, 1.5])
    np.testing.assert_array_equal(path.scaled(2.0).times_s, [0.0, 0.75])


@pytest.mark.parametrize(
    ("points", "problem"),
    [
        ([{"positions": [0.0]}], "has 1 positions for 2 joints"),
        ([{"positions": [0.0, float("nan")]}], "not a finite number"),
        ([{"positions": [0.0, 0.0], "time_from_start": 2}, {"positions": [0.0, 0.0]}], "do not ascend"),
    ],
)
def test_trajectories_that_are_none_are_refused(points: list[dict[str, Any]], problem: str) -> None:
    from trundle.planning.move_group.controllers.joint_path import TrajectoryError

    message = Messages().new("trajectory_msgs/JointTrajectory", {"joint_names": ["a", "b"], "points": points})

    with pytest.raises(TrajectoryError, match=problem):
        path_from_message(message)
