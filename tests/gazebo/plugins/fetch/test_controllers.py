"""Joints behind robot_controllers: trajectories, the head, the gripper, the base."""

import math
from typing import Any

import pytest
from tests.gazebo.plugins.ros_control.controlled import INERTIAL
from tests.gazebo_server import Gazebo, until

_SUCCEEDED, _ABORTED = 3, 4
_LIMIT = '<limit lower="{0}" upper="{1}" effort="60" velocity="2"/>'


def _joint(name: str, kind: str, axis: str, *, lower: float = -2.0, upper: float = 2.0, parent: str = "base") -> str:
    limit = _LIMIT.format(lower, upper)
    return f"""<link name="{name}_link">{INERTIAL}</link>
<joint name="{name}_joint" type="{kind}"><parent link="{parent}"/><child link="{name}_link"/><axis xyz="{axis}"/>{limit}
</joint>"""


_ROBOT = f"""<robot name="fetch"><link name="world"/><link name="base">{INERTIAL}</link>
<joint name="fix" type="fixed"><parent link="world"/><child link="base"/><origin xyz="0 0 5"/></joint>
{_joint("l_wheel", "continuous", "0 1 0")}{_joint("r_wheel", "continuous", "0 1 0")}
{_joint("torso", "prismatic", "0 0 1", lower=0.0, upper=0.4)}{_joint("bellows", "prismatic", "0 0 1")}
{_joint("shoulder", "revolute", "0 1 0")}{_joint("elbow", "revolute", "0 1 0", parent="shoulder_link")}
{_joint("head_pan", "revolute", "0 0 1")}{_joint("head_tilt", "revolute", "0 1 0", parent="head_pan_link")}
{_joint("l_gripper_finger", "prismatic", "0 1 0", lower=0.0, upper=0.05)}
{_joint("r_gripper_finger", "prismatic", "0 -1 0", lower=0.0, upper=0.05)}
<gazebo><plugin name="fetch" filename="libfetch_gazebo_plugin.so"/></gazebo></robot>"""
_FOLLOW = "robot_controllers/FollowJointTrajectoryController"
_PARAMETERS: dict[str, Any] = {
    "/arm_controller/follow_joint_trajectory": {"type": _FOLLOW, "joints": ["shoulder_joint", "elbow_joint"]},
    "/arm_controller/gravity_compensation": {"type": "robot_controllers/GravityCompensation", "autostart": True},
    "/both/follow_joint_trajectory": {"type": _FOLLOW, "joints": ["torso_joint", "shoulder_joint", "elbow_joint"]},
    "/head_controller/point_head": {"type": "robot_controllers/PointHeadController"},
    "/gripper_controller/gripper_action": {"type": "robot_controllers/ParallelGripperController"},
    "/base_controller": {"type": "robot_controllers/DiffDriveBaseController", "autostart": True, "timeout": 100.0},
    "/bellows_controller": {
        "type": "robot_controllers/ScaledMimicController",
        "mimic_joint": "torso_joint",
        "controlled_joint": "bellows_joint",
        "mimic_scale": 0.5,
        "autostart": True,
    },
    "/odd": {"type": "robot_controllers/CartesianTwistController"},
}


class _Robot:
    """Fetch in a running world, and its joint states."""

    def __init__(self, gazebo: Gazebo) -> None:
        self.gazebo, self.positions, self.actions = gazebo, dict[str, float](), dict[str, Any]()
        for name, value in {**_PARAMETERS, "/gazebo/default_controllers": [n.strip("/") for n in _PARAMETERS]}.items():
            gazebo.loop.run(gazebo.client.params.set(name, value))
        gazebo.client.subscribe("/joint_states", "sensor_msgs/JointState", self._on_states)
        answer = gazebo.call("spawn_urdf_model", "gazebo_msgs/SpawnModel", model_name="fetch", model_xml=_ROBOT)
        assert answer.success, answer.status_message
        gazebo.call("unpause_physics")
        until(lambda: self.positions)

    def _on_states(self, message: Any) -> None:
        self.positions = dict(zip(message.name, message.position, strict=True))

    def describe(self) -> None:
        """Publish the frames of base and head."""
        pan = {"header": {"frame_id": "base"}, "child_frame_id": "head_pan_link", "transform": {"rotation": {"w": 1.0}}}
        self.gazebo.advertise("/tf_static", "tf2_msgs/TFMessage")({"transforms": [pan]})

    def send(self, action: str, kind: str, **goal: Any) -> Any:
        """Send a goal of control_msgs, and return its result."""
        if action not in self.actions:
            results = self.gazebo.subscribe(f"{action}/result", f"control_msgs/{kind}ActionResult")
            self.actions[action] = results, self.gazebo.advertise(f"{action}/goal", f"control_msgs/{kind}ActionGoal")
        results, publish = self.actions[action]
        count = len(results)
        publish({"goal_id": {"id": f"{action} {count}"}, "goal": goal})
        until(lambda: len(results) > count)
        return results[-1]

    def follow(self, controller: str, **positions: float) -> Any:
        """Send a trajectory of 0.3 s."""
        point = {"positions": [*positions.values()], "time_from_start": 300_000_000}
        names = [f"{name}_joint" for name in positions]
        action = f"/{controller}/follow_joint_trajectory"
        return self.send(action, "FollowJointTrajectory", trajectory={"joint_names": names, "points": [point]})


@pytest.fixture
def robot(gazebo: Gazebo) -> _Robot:
    return _Robot(gazebo)


def test_a_goal_starts_its_controller_and_stops_those_with_its_joints(robot: _Robot) -> None:
    arm = robot.follow("arm_controller", shoulder=0.5, elbow=-0.4)
    both = robot.follow("both", torso=0.2, shoulder=0.1, elbow=0.3)
    again = robot.follow("arm_controller", shoulder=-0.3, elbow=0.0)

    assert [result.status.status for result in (arm, both, again)] == [_SUCCEEDED] * 3
    until(lambda: abs(robot.positions["shoulder_joint"] + 0.3) < 0.01)
    assert robot.positions["torso_joint"] == pytest.approx(0.2, abs=0.01)  # held, though no controller has it
    assert robot.positions["bellows_joint"] == pytest.approx(0.1, abs=0.01)


def test_the_head_turns_to_a_point(robot: _Robot) -> None:
    """The point is one metre before, one left of and one above the base."""
    target = {"header": {"frame_id": "base"}, "point": {"x": 1.0, "y": 1.0, "z": 1.0}}
    robot.describe()
    result = robot.send("/head_controller/point_head", "PointHead", target=target)

    assert result.status.status == _SUCCEEDED, result.status.text
    until(lambda: abs(robot.positions["head_pan_joint"] - math.pi / 4) < 0.01)
    assert robot.positions["head_tilt_joint"] == pytest.approx(-math.atan2(1.0, math.sqrt(2.0)), abs=0.01)
    lost = robot.send("/head_controller/point_head", "PointHead", target={"header": {"frame_id": "nowhere"}})
    assert lost.status.status == _ABORTED


def test_the_gripper_opens_and_closes_by_both_fingers(robot: _Robot) -> None:
    action = "/gripper_controller/gripper_action"
    opened = robot.send(action, "GripperCommand", command={"position": 0.08, "max_effort": 0.0})

    assert opened.status.status == _SUCCEEDED
    assert opened.result.reached_goal
    assert opened.result.position == pytest.approx(0.08, abs=0.01)
    fingers = ("l_gripper_finger_joint", "r_gripper_finger_joint")
    until(lambda: all(abs(robot.positions[name] - 0.04) < 0.001 for name in fingers))


def test_the_base_drives_and_tells_where_it_is(robot: _Robot) -> None:
    odometry = robot.gazebo.subscribe("/odom", "nav_msgs/Odometry")
    robot.gazebo.advertise("/base_controller/command", "geometry_msgs/Twist")({"linear": {"x": 0.1}})
    until(lambda: odometry and odometry[-1].twist.twist.linear.x > 0.09)

    assert odometry[-1].header.frame_id == "odom"
    assert odometry[-1].child_frame_id == "base_link"
    until(lambda: odometry[-1].pose.pose.position.x > 0.02)
    assert odometry[-1].pose.pose.position.y == pytest.approx(0.0, abs=0.02)
