"""Joint trajectories by topic and action, and grippers."""

from collections.abc import Iterator
from typing import Any

import pytest
from tests.gazebo.plugins.ros_control.controlled import Robot, driven, fixed_robot
from tests.gazebo_server import Gazebo, until

from trundle.gazebo.plugins.ros_control.plugin import GazeboRosControl
from trundle.ros import Message, ServiceError
from trundle.sim.control import Servo

_LIMIT = '<limit lower="-2" upper="2" effort="200" velocity="10"/>'
_ROBOT = fixed_robot(
    driven("a", "revolute", "PositionJointInterface", limit=_LIMIT),
    driven("b", "continuous", "PositionJointInterface"),
    driven("c", "revolute", "EffortJointInterface", limit=_LIMIT),
    driven("d", "prismatic", "VelocityJointInterface", limit=_LIMIT),
    driven("e", "prismatic", "PositionJointInterface", limit=_LIMIT.replace("2", "200", 2)),
    driven("f", "prismatic", "PositionJointInterface", limit=_LIMIT.replace("2", "200", 2)),
    driven("finger", "prismatic", "EffortJointInterface", axis="1 0 0", limit=_LIMIT.replace("2", "0.5", 2)),
)
_GAINS = {"p": 900.0, "d": 60.0, "i": 0.0}
_CONTROLLERS: dict[str, Any] = {
    "arm": {
        "type": "position_controllers/JointTrajectoryController",
        "joints": ["a", "b"],
        "constraints": {"goal_time": 1.0, "a": {"goal": 0.01}},
    },
    "pushed": {
        "type": "effort_controllers/JointTrajectoryController",
        "joints": ["c"],
        "gains": {"c": _GAINS},
        "constraints": {"goal_time": 5.0, "c": {"goal": 0.05}},
    },
    "slid": {
        "type": "velocity_controllers/JointTrajectoryController",
        "joints": ["d"],
        "gains": {"d": {"p": 20.0}},
        "velocity_ff": {"d": 1.0},
        "constraints": {"goal_time": 5.0, "stopped_velocity_tolerance": 0.05},
    },
    "ramp": {
        "type": "position_controllers/JointTrajectoryController",
        "joints": ["e", "f"],
        "allow_partial_joints_goal": True,
        "stop_trajectory_duration": 0.5,
        "state_publish_rate": 200,
    },
    "hand": {
        "type": "effort_controllers/GripperActionController",
        "joint": "finger",
        "gains": {"finger": {"p": 200.0, "d": 30.0}},
        "stall_timeout": 0.3,
    },
}
FOLLOW = "control_msgs/FollowJointTrajectory"
SUCCEEDED, ABORTED, PREEMPTED, REJECTED = 3, 4, 2, 5


@pytest.fixture
def robot(gazebo: Gazebo) -> Iterator[Robot]:
    running = Robot(gazebo, _ROBOT, _CONTROLLERS)
    running.spawn(*_CONTROLLERS)
    yield running
    running.close()


def point(*positions: float, at_s: float, **fields: list[float]) -> dict[str, Any]:
    ns = round(at_s * 1e9)
    return {"positions": list(positions), "time_from_start": {"sec": ns // 10**9, "nanosec": ns % 10**9}, **fields}


def trajectory(joints: list[str], *points: dict[str, Any]) -> dict[str, Any]:
    return {"trajectory": {"joint_names": joints, "points": list(points)}}


def send_goal(
    robot: Robot, controller: str, goal: dict[str, Any], *, kind: str = FOLLOW, key: str = "1"
) -> list[Message]:
    """Send a goal; return the list of the action's results."""
    name = f"/r/{controller}/{'gripper_cmd' if kind != FOLLOW else 'follow_joint_trajectory'}"
    results = robot.gazebo.subscribe(f"{name}/result", f"{kind}ActionResult")
    robot.gazebo.advertise(f"{name}/goal", f"{kind}ActionGoal")({"goal_id": {"id": key}, "goal": goal})
    return results


@pytest.mark.parametrize(
    ("controller", "joints", "goal"),
    [("arm", ["b", "a"], (0.5, -1.0)), ("pushed", ["c"], (0.75,)), ("slid", ["d"], (0.3,))],
)
def test_a_goal_is_reached_in_time(robot: Robot, controller: str, joints: list[str], goal: tuple[float, ...]) -> None:
    zero = [0.0] * len(goal)
    points = [point(*(value / 2 for value in goal), at_s=0.3), point(*goal, at_s=0.8, velocities=zero)]
    results = send_goal(robot, controller, trajectory(joints, *points))
    until(lambda: results)

    assert (results[0].status.status, results[0].result.error_code) == (SUCCEEDED, 0), results[0].status.text
    for joint, value in zip(joints, goal, strict=True):
        assert robot.joint(joint).position[0] == pytest.approx(value, abs=0.05)


@pytest.mark.parametrize(
    ("goal", "code", "text"),
    [
        (
            trajectory(["a"], point(1.0, at_s=1.0)),
            -2,
            "Joints on incoming goal don't match the controller joints. They are a, b; it has a.",
        ),
        (trajectory([], point(at_s=1.0)), -2, "it has none."),
        (trajectory(["a"]), -2, "it has a."),
        (trajectory(["a", "b"], point(1, 1, at_s=0.0)), -1, "Dropping all 1 trajectory point(s)"),
        (trajectory(["a", "b"], point(1.0, at_s=1.0)), -1, "Size mismatch"),
        (trajectory(["a", "b"], point(1, 1, at_s=1.0), point(1, 1, at_s=1.0)), -1, "not strictly increasing in time"),
    ],
)
def test_an_invalid_goal_is_refused(robot: Robot, goal: dict[str, Any], code: int, text: str) -> None:
    results = send_goal(robot, "arm", goal)
    until(lambda: results)
    assert (results[0].status.status, results[0].result.error_code) == (REJECTED, code)
    assert text in results[0].result.error_string


def test_a_controller_that_does_not_run_refuses_goals_topics_and_queries(robot: Robot) -> None:
    log = robot.gazebo.subscribe("/rosout_agg", "rosgraph_msgs/Log")
    assert robot.call("switch_controller", "SwitchController", stop_controllers=["arm"], strictness=2).ok
    goal = trajectory(["a", "b"], point(1.0, 1.0, at_s=1.0))
    results = send_goal(robot, "arm", goal)
    robot.gazebo.advertise("/r/arm/command", "trajectory_msgs/JointTrajectory")(goal["trajectory"])
    until(lambda: results)
    assert (results[0].status.status, results[0].result.error_code) == (REJECTED, -1)
    until(lambda: any("Can't accept new commands. Controller is not running." in str(line.msg) for line in log))
    with pytest.raises(ServiceError, match=r"Can't sample trajectory\. Controller is not running"):
        _query(robot, 1)


def _query(robot: Robot, secs: int) -> Message:
    kind = "control_msgs/QueryTrajectoryState"
    call = robot.gazebo.client.call_service("/r/arm/query_state", kind, {"time": {"secs": secs}})
    return robot.gazebo.loop.run(call)


def test_a_goal_without_points_stops_and_succeeds(robot: Robot) -> None:
    results = send_goal(robot, "arm", trajectory(["a", "b"], point(1.0, 1.0, at_s=500.0)), key="slow")
    until(lambda: robot.joint("a").position[0] > 0.0)
    send_goal(robot, "arm", trajectory(["a", "b"]), key="stop")
    until(lambda: len(results) == 2)
    assert {r.status.goal_id.id: r.status.status for r in results} == {"slow": PREEMPTED, "stop": SUCCEEDED}
    position = robot.joint("a").position[0]
    robot.gazebo.until_s(robot.gazebo.time_s + 0.2)
    assert robot.joint("a").position[0] == pytest.approx(position, abs=1e-4)


def test_a_stop_has_its_duration_and_a_partial_goal_keeps_other_joints_moving(robot: Robot) -> None:
    states = robot.gazebo.subscribe("/r/ramp/state", "control_msgs/JointTrajectoryControllerState")
    results = send_goal(robot, "ramp", trajectory(["e", "f"], point(100.0, 100.0, at_s=100.0)), key="both")
    until(lambda: states and states[-1].desired.velocities[0] == pytest.approx(1.0))
    send_goal(robot, "ramp", trajectory(["f"], point(0.0, at_s=0.3)), key="one")
    until(lambda: results)
    assert (results[0].status.goal_id.id, results[0].status.status) == ("both", PREEMPTED)
    until(lambda: states[-1].desired.velocities[1] == 0.0)
    assert states[-1].desired.velocities[0] == pytest.approx(1.0)
    assert len(results) == 1  # e still is on its way
    start, count = states[-1].desired.positions[0], len(states)
    robot.gazebo.advertise("/r/ramp/follow_joint_trajectory/cancel", "actionlib_msgs/GoalID")({})
    until(lambda: states[-1].desired.velocities[0] == 0.0)
    assert (results[1].status.goal_id.id, results[1].status.status) == ("one", PREEMPTED)
    speeds = [state.desired.velocities[0] for state in states[count:]]
    assert any(0.1 < speed < 0.9 for speed in speeds)
    moving = [s.desired.positions[0] for s in states[count - 1 :] if s.desired.velocities[0] == pytest.approx(1.0)]
    # 0.625 v T after the cancel, which falls between two messages
    assert states[-1].desired.positions[0] - (moving or [start])[-1] == pytest.approx(0.625 * 0.5, abs=0.02)


def test_a_refused_goal_does_not_stop_the_running_goal(robot: Robot) -> None:
    results = send_goal(robot, "arm", trajectory(["a", "b"], point(1.0, 1.0, at_s=1.0)), key="good")
    states = robot.gazebo.subscribe("/r/arm/follow_joint_trajectory/status", "actionlib_msgs/GoalStatusArray")
    until(lambda: robot.joint("a").position[0] > 0.0)
    send_goal(robot, "arm", trajectory(["a"], point(1.0, at_s=1.0)), key="bad")
    until(lambda: len(results) == 2)
    assert [(r.status.goal_id.id, r.status.status) for r in results] == [("bad", REJECTED), ("good", SUCCEEDED)]
    assert {s.status for state in states for s in state.status_list if s.goal_id.id == "bad"} <= {0, REJECTED}


def test_stopping_a_controller_preempts_its_goal(robot: Robot) -> None:
    results = send_goal(robot, "arm", trajectory(["a", "b"], point(1.0, 1.0, at_s=500.0)))
    until(lambda: robot.joint("a").position[0] > 0.0)
    robot.call("switch_controller", "SwitchController", stop_controllers=["arm"], strictness=2)
    until(lambda: results)
    assert results[0].status.status == PREEMPTED


def test_trajectories_and_grippers_run_in_the_step_action(robot: Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    actions: list[object] = []
    step_action = GazeboRosControl.step_action

    def recorded(plugin: GazeboRosControl) -> tuple[Servo, float] | None:
        actions.append(step_action(plugin))
        return step_action(plugin)

    monkeypatch.setattr(GazeboRosControl, "step_action", recorded)
    send_goal(robot, "arm", trajectory(["a", "b"], point(1.0, 1.0, at_s=500.0)))
    until(lambda: robot.joint("a").position[0] > 0.0 and len(actions) > 5)

    assert None not in actions


def test_an_unreachable_goal_is_aborted(robot: Robot) -> None:
    results = send_goal(robot, "arm", trajectory(["a", "b"], point(5.0, 0.0, at_s=0.2)))  # beyond the stop of a
    until(lambda: results)
    assert (results[0].status.status, results[0].result.error_code) == (ABORTED, -5)
    assert results[0].result.error_string.startswith("a goal error ")


def test_a_missed_goal_is_aborted_after_its_goal_time_tolerance(robot: Robot) -> None:
    tolerances = {"goal_time_tolerance": {"sec": -1, "nanosec": 0}, "goal_tolerance": [{"name": "c", "position": 1e-6}]}
    results = send_goal(robot, "pushed", {**trajectory(["c"], point(1.0, at_s=0.1)), **tolerances})
    feedback = robot.gazebo.subscribe(
        "/r/pushed/follow_joint_trajectory/feedback", "control_msgs/FollowJointTrajectoryActionFeedback"
    )
    until(lambda: results)
    assert (results[0].status.status, results[0].result.error_code) == (ABORTED, -5)
    assert all(message.feedback.actual.time_from_start.sec == 0 for message in feedback)


def test_a_violated_path_tolerance_aborts_the_goal_and_the_motion_goes_on(robot: Robot) -> None:
    goal = trajectory(["c"], point(1.9, at_s=0.02), point(1.9, at_s=1.0))
    results = send_goal(robot, "pushed", {**goal, "path_tolerance": [{"name": "c", "position": 0.1}]})
    until(lambda: results)
    assert (results[0].status.status, results[0].result.error_code) == (ABORTED, -4)
    assert results[0].result.error_string.startswith("c path error 0.1")
    until(lambda: robot.joint("c").position[0] == pytest.approx(1.9, abs=0.01))


def test_a_new_goal_and_a_cancel_preempt(robot: Robot) -> None:
    slow = trajectory(["a", "b"], point(1.0, 1.0, at_s=500.0))
    results = send_goal(robot, "arm", slow, key="first")
    until(lambda: robot.joint("a").position[0] > 0.0)
    send_goal(robot, "arm", slow, key="second")
    until(lambda: len(results) == 1)
    assert (results[0].status.goal_id.id, results[0].status.status) == ("first", PREEMPTED)
    robot.gazebo.advertise("/r/arm/follow_joint_trajectory/cancel", "actionlib_msgs/GoalID")({})
    until(lambda: len(results) == 2)
    assert (results[1].status.goal_id.id, results[1].status.status) == ("second", PREEMPTED)


def test_the_topic_moves_the_joints_and_states_are_published(robot: Robot) -> None:
    states = robot.gazebo.subscribe("/r/arm/state", "control_msgs/JointTrajectoryControllerState")
    command = robot.gazebo.advertise("/r/arm/command", "trajectory_msgs/JointTrajectory")
    command(trajectory(["a", "b"], point(0.4, 2.0 + 6.283185307, at_s=0.3))["trajectory"])  # b takes the shorter way

    def has_arrived() -> bool:
        return bool(states) and states[-1].actual.positions[0] == pytest.approx(0.4, abs=5e-3)

    until(has_arrived)
    until(lambda: robot.joint("b").position[0] == pytest.approx(2.0, abs=1e-2))
    assert list(states[-1].joint_names) == ["a", "b"]
    assert states[-1].actual.time_from_start.sec - states[-1].desired.time_from_start.sec >= 0
    assert _query(robot, 10**6).position[0] == pytest.approx(0.4)
    with pytest.raises(ServiceError, match=r"Requested sample time precedes trajectory start time\."):
        _query(robot, 0)
    command({"joint_names": ["a", "b"]})  # holds
    command(trajectory(["a", "b"], point(-1.0, 0.0, at_s=0.0))["trajectory"])  # refused
    robot.gazebo.until_s(robot.gazebo.time_s + 0.2)
    assert robot.joint("a").position[0] == pytest.approx(0.4, abs=5e-3)


def test_a_gripper_reaches_its_goal_and_stalls_at_its_stop(robot: Robot) -> None:
    kind = "control_msgs/GripperCommand"
    results = send_goal(robot, "hand", {"command": {"position": 0.2}}, kind=kind)
    until(lambda: results)
    assert (results[0].status.status, results[0].result.reached_goal) == (SUCCEEDED, True)
    send_goal(robot, "hand", {"command": {"position": 3.0, "max_effort": 5.0}}, kind=kind, key="2")
    until(lambda: len(results) == 2)
    assert (results[1].status.status, results[1].result.stalled) == (ABORTED, True)
    assert results[1].result.position == pytest.approx(0.5, abs=0.02)
