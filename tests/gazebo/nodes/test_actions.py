"""Actions: transform lookup, servo trajectories and grippers."""

import math
from typing import Any

import pytest

from trundle.gazebo.nodes.arbotix.gripper_controller import read_gripper
from trundle.robots.parameters import ParamError, RosParameters

SUCCEEDED, ABORTED, PREEMPTED = 3, 4, 2
ARBOTIX: dict[str, Any] = {
    "sim": True,
    "rate": 100.0,
    "write_rate": 50.0,
    "read_rate": 50.0,
    "joints": {"pan": {"id": 1}, "tilt": {"id": 2}},
    "controllers": {
        "arm": {"type": "follow_controller", "joints": ["pan", "tilt"], "action_name": "arm/follow_joint_trajectory"}
    },
}
FOLLOW = "control_msgs/FollowJointTrajectory"


def send_goal(graph, name: str, type_name: str, goal: dict[str, Any], *, key: str = "1") -> Any:
    """Send a goal; return the publisher of goals and the list of results."""
    results = graph.listen(f"{name}/result", f"{type_name}ActionResult")
    goals = graph.advertise(f"{name}/goal", f"{type_name}ActionGoal")
    graph.until(lambda: graph.connected(f"{name}/result"))
    goals.publish({"goal_id": {"id": key}, "goal": goal})
    return goals, results


def point(*positions: float, at_s: float) -> dict[str, Any]:
    ns = round(at_s * 1e9)
    return {"positions": list(positions), "time_from_start": {"sec": ns // 10**9, "nanosec": ns % 10**9}}


def test_servos_follow_a_trajectory(graph) -> None:
    """The action's name is the node's to resolve, not below the controller's."""
    controllers = {"arm": {"type": "follow_controller", "joints": ["pan", "tilt"]}}
    graph.start("arbotix_python/arbotix_driver", name="arbotix", **{**ARBOTIX, "controllers": controllers})
    states = graph.listen("/joint_states", "sensor_msgs/JointState")
    trajectory = {"joint_names": ["tilt", "pan"], "points": [point(0.4, -0.2, at_s=0.3), point(0.4, 0.1, at_s=0.6)]}
    _, results = send_goal(graph, "/follow_joint_trajectory", FOLLOW, {"trajectory": trajectory})
    graph.until(lambda: results)

    assert (results[0].status.status, results[0].status.text) == (SUCCEEDED, "Trajectory execution complete")

    def position(joint: str) -> float:
        return dict(zip(states[-1].name, states[-1].position, strict=True))[joint]

    # Ticks are 0.3 degrees; the last hundredth of a second is not waited for.
    graph.until(lambda: position("tilt") == pytest.approx(0.4, abs=0.01))
    graph.until(lambda: position("pan") == pytest.approx(0.1, abs=0.02))


@pytest.mark.parametrize(
    ("trajectory", "text"),
    [
        ({"joint_names": ["pan"], "points": [point(0.1, at_s=0.1)]}, "'tilt' is missing"),
        ({"joint_names": ["pan", "tilt"]}, "Trajectory empty."),
        ({"joint_names": ["pan", "tilt"], "points": [point(0.1, at_s=0.1)]}, "fewer positions"),
    ],
)
def test_an_invalid_trajectory_is_aborted(graph, trajectory: dict[str, Any], text: str) -> None:
    graph.start("arbotix_python/arbotix_driver", name="arbotix", **ARBOTIX)
    _, results = send_goal(graph, "/arm/follow_joint_trajectory", FOLLOW, {"trajectory": trajectory})
    graph.until(lambda: results)
    assert results[0].status.status == ABORTED
    assert text in results[0].status.text


def test_a_new_goal_preempts_and_a_cancel_ends_it(graph) -> None:
    graph.start("arbotix_python/arbotix_driver", name="arbotix", **ARBOTIX)
    slow = {"trajectory": {"joint_names": ["pan", "tilt"], "points": [point(1.0, 1.0, at_s=100.0)]}}
    goals, results = send_goal(graph, "/arm/follow_joint_trajectory", FOLLOW, slow, key="first")
    status = graph.listen("/arm/follow_joint_trajectory/status", "actionlib_msgs/GoalStatusArray")
    graph.until(lambda: status and [s.status for s in status[-1].status_list] == [1])
    goals.publish({"goal_id": {"id": "second"}, "goal": slow})
    graph.until(lambda: len(results) == 1)
    assert (results[0].status.goal_id.id, results[0].status.status) == ("first", PREEMPTED)

    graph.advertise("/arm/follow_joint_trajectory/cancel", "actionlib_msgs/GoalID").publish({})
    graph.until(lambda: len(results) == 2)
    assert (results[1].status.goal_id.id, results[1].status.status) == ("second", PREEMPTED)


def test_a_controller_without_its_servos_is_reported(graph, capsys) -> None:
    controllers = {"arm": {"type": "follow_controller", "joints": ["elbow"]}}
    graph.start("arbotix_python/arbotix_driver", name="arbotix", **{**ARBOTIX, "controllers": controllers})
    log_text = ""

    def is_reported() -> bool:
        nonlocal log_text
        log_text += capsys.readouterr().err
        return "no servo 'elbow'; servos here: pan, tilt; it is left out" in log_text

    graph.until(is_reported)


def test_the_buffer_server_looks_up_transforms(graph) -> None:
    graph.start("tf2_ros/static_transform_publisher", "1 2 3 0 0 0 base camera", name="still")
    graph.start("tf2_ros/buffer_server")
    type_name = "tf2_msgs/LookupTransform"
    goal = {"target_frame": "base", "source_frame": "camera", "timeout": {"sec": 60}}
    goals, results = send_goal(graph, "/tf2_buffer_server", type_name, goal)
    graph.until(lambda: results)
    assert results[0].status.status == SUCCEEDED
    assert results[0].result.transform.transform.translation.y == 2.0

    goals.publish({"goal_id": {"id": "2"}, "goal": {**goal, "source_frame": "moon", "timeout": {}}})
    graph.until(lambda: len(results) == 2)
    assert (results[1].status.status, results[1].result.error.error) == (SUCCEEDED, 1)  # clients look no further else
    assert "moon" in results[1].result.error.error_string

    for number, (target, source, error) in enumerate([("/base", "camera", 4), ("base", "", 4), ("base", "base", 0)]):
        frames = {"target_frame": target, "source_frame": source}
        goals.publish({"goal_id": {"id": f"more{number}"}, "goal": frames})
        graph.until(lambda expected=number + 3: len(results) == expected)
        assert (results[-1].status.status, results[-1].result.error.error) == (SUCCEEDED, error)


@pytest.mark.parametrize(
    ("settings", "opening_m", "commands"),
    [
        ({"model": "parallel", "scale": 2.0, "center": 0.5, "joint": "g"}, 0.1, {"g": 0.7}),
        ({"model": "singlesided", "pad_width": 0.0, "finger_length": 0.05}, 0.05, {"gripper_joint": math.pi / 6}),
        ({"model": "singlesided", "invert": True, "center": 0.1, "max_opening": 0.01}, 9.0, {"gripper_joint": 0.1}),
        (
            {"model": "dualservo", "pad_width": 0.0, "finger_length": 0.05},
            0.05,
            {"l_gripper_joint": math.pi / 6, "r_gripper_joint": -math.pi / 6},
        ),
    ],
)
def test_an_opening_becomes_servo_angles(
    settings: dict[str, Any], opening_m: float, commands: dict[str, float]
) -> None:
    """A finger of length l opens 2·l·sin(angle) beyond its pads."""
    assert read_gripper(RosParameters(settings, "/g")).commands(opening_m) == pytest.approx(commands)


def test_invalid_openings_and_models_are_rejected() -> None:
    with pytest.raises(ValueError, match="exceeds the opening limits"):
        read_gripper(RosParameters({"model": "dualservo"}, "/g")).commands(0.5)
    with pytest.raises(ValueError, match="cannot open"):
        read_gripper(RosParameters({"model": "dualservo", "finger_length": 0.001}, "/g")).commands(0.05)
    with pytest.raises(ParamError, match="no gripper model 'tentacle'"):
        read_gripper(RosParameters({"model": "tentacle"}, "/g"))


def test_a_gripper_opens_as_its_servo_does(graph) -> None:
    graph.start("arbotix_python/arbotix_driver", name="arbotix", **{**ARBOTIX, "joints": {"gripper_joint": {"id": 1}}})
    graph.start("arbotix_controllers/gripper_controller", name="grip", model="singlesided")
    graph.until(lambda: graph.linked("/gripper_joint/command") and graph.linked("/joint_states"))
    _, results = send_goal(
        graph, "/grip/gripper_action", "control_msgs/GripperCommand", {"command": {"position": 0.03}}
    )
    graph.until(lambda: results)

    assert (results[0].status.status, results[0].result.reached_goal) == (SUCCEEDED, True)
