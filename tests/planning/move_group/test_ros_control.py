"""move_group with the controller manager of a simulated arm: tolerances, cancelled goals, worlds that change."""

from collections.abc import Iterator
from typing import Any

import pytest
from tests.gazebo.nodes.conftest import NodeGraph
from tests.gazebo.plugins.ros_control.controlled import Robot
from tests.gazebo_server import Gazebo, bare_gazebo as bare_gazebo, gazebo as gazebo
from tests.planning.move_group.arm_graph import box, joint_goal, request

_JOINTS = ["turn", "lift"]
_SUCCEEDED, _PREEMPTED, _ABORTED = 3, 2, 4
_SUCCESS, _CONTROL_FAILED, _CANCELLED = 1, -4, -7


def _joint(name: str, parent: str, child: str, axis: str, z: float, limits: str) -> str:
    return f"""<joint name="{name}" type="revolute"><parent link="{parent}"/><child link="{child}"/>
<origin xyz="0 0 {z}"/><axis xyz="{axis}"/><limit {limits} effort="200" velocity="2"/><dynamics damping="0.5"/></joint>
<transmission name="{name}_t"><type>transmission_interface/SimpleTransmission</type>
<joint name="{name}"><hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface></joint>
<actuator name="{name}_m"><mechanicalReduction>1</mechanicalReduction></actuator></transmission>"""


def _link(name: str, mass: float, inertia: float, x: float, z: float, size: str) -> str:
    return f"""<link name="{name}"><inertial><origin xyz="{x} 0 {z}"/><mass value="{mass}"/>
<inertia ixx="{inertia}" iyy="{inertia}" izz="{inertia}" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><origin xyz="{x} 0 {z}"/><geometry><box size="{size}"/></geometry></collision></link>"""


_ARM = f"""<robot name="r"><link name="world"/>{_link("base", 5.0, 0.05, 0.0, 0.1, "0.2 0.2 0.2")}
<joint name="fix" type="fixed"><parent link="world"/><child link="base"/></joint>
{_link("post", 1.0, 0.01, 0.0, 0.1, "0.08 0.08 0.2")}{_link("boom", 1.0, 0.03, 0.3, 0.0, "0.6 0.05 0.05")}
{_joint("turn", "base", "post", "0 0 1", 0.22, 'lower="-2.8" upper="2.8"')}
{_joint("lift", "post", "boom", "0 -1 0", 0.25, 'lower="-0.3" upper="1.5"')}
<gazebo><plugin name="control" filename="libgazebo_ros_control.so"><robotNamespace>/r</robotNamespace></plugin></gazebo>
</robot>"""
"""A boom of 1 kg, 0.3 m before its axis: gravity pulls it down with 2.9 Nm."""
_SRDF = """<robot name="r"><group name="arm"><joint name="turn"/><joint name="lift"/></group>
<disable_collisions link1="base" link2="post" reason="Adjacent"/>
<disable_collisions link1="post" link2="boom" reason="Adjacent"/>
<disable_collisions link1="base" link2="boom" reason="Never"/></robot>"""
_STIFF = {"p": 600.0, "d": 25.0, "i": 100.0, "i_clamp": 20.0}
_SLACK = {"p": 15.0, "d": 8.0}
"""Under 2.9 Nm it gives way by 0.2 rad."""


class _PlannedArm:
    """The arm in its world, with move_group."""

    def __init__(self, gazebo: Gazebo, graph: NodeGraph, gains: dict[str, float], constraints: dict[str, Any]) -> None:
        controller = {
            "type": "effort_controllers/JointTrajectoryController",
            "joints": _JOINTS,
            "gains": {"turn": _STIFF, "lift": gains},
            "constraints": constraints,
        }
        states = {"type": "joint_state_controller/JointStateController", "publish_rate": 100}
        self.robot = Robot(gazebo, _ARM, {"controller": controller, "states": states})
        self.robot.spawn("controller", "states")
        self._gazebo, self._graph = gazebo, graph
        limits = {name: {"has_acceleration_limits": True, "max_acceleration": 4.0} for name in _JOINTS}
        graph.set_params(
            {
                "/r/robot_description_semantic": _SRDF,
                "/r/robot_description_planning": {"joint_limits": limits},
                "/r/move_group": {
                    "moveit_controller_manager": "moveit_ros_control_interface::MoveItControllerManager",
                    "ros_control_namespace": "/r",
                    "trajectory_execution": {"allowed_start_tolerance": 0.5, "allowed_goal_duration_margin": 5.0},
                },
            }
        )
        self.log = gazebo.subscribe("/rosout_agg", "rosgraph_msgs/Log")
        graph.start("moveit_ros_move_group/move_group", name="/r/move_group")
        self.results = graph.listen("/r/move_group/result", "moveit_msgs/MoveGroupActionResult")
        self._send = graph.advertise("/r/move_group/goal", "moveit_msgs/MoveGroupActionGoal")
        self._cancel = graph.advertise("/r/move_group/cancel", "actionlib_msgs/GoalID")
        graph.until(lambda: graph.connected("/r/move_group/result"))

    def send(self, goal: dict[str, float], *, speed: float = 1.0, **options: Any) -> None:
        """Send a goal of joints, with planning options."""
        wanted = {**request(joint_goal(goal, tolerance=0.01)), "max_velocity_scaling_factor": speed}
        self._send.publish({"goal": {"request": wanted, "planning_options": options}})

    def run(self, goal: dict[str, float]) -> tuple[int, int]:
        """Run a goal; returns the state of the action and the result's error code."""
        self.send(goal)
        self._graph.until(lambda: self.results)
        return self.ended()

    def ended(self) -> tuple[int, int]:
        """Return the state of the action and the result's error code."""
        (message,) = self.results
        return int(message.status.status), int(message.result.error_code.val)

    def cancel(self) -> None:
        """Cancel the goal."""
        self._cancel.publish({})

    def position(self, joint: str) -> float:
        """Return a joint's true position [rad]."""
        return float(self.robot.joint(joint).position[0])

    def said(self, words: str) -> bool:
        """True once a line of the log has the words."""
        self._graph.until(lambda: any(words in str(line.msg) for line in self.log))
        return True

    def close(self) -> None:
        """Shut down the spawners."""
        self.robot.close()


@pytest.fixture
def graph(gazebo: Gazebo) -> Iterator[NodeGraph]:
    """Stand-ins on the world's graph."""
    nodes = NodeGraph(gazebo.loop, gazebo.client.master_uri, gazebo.client)
    yield nodes
    nodes.stop()


def test_a_motion_that_a_controller_follows_succeeds(gazebo: Gazebo, graph: NodeGraph) -> None:
    arm = _PlannedArm(gazebo, graph, _STIFF, {"goal_time": 2.0, "lift": {"goal": 0.05, "trajectory": 0.3}})

    assert arm.run({"turn": 1.0, "lift": 0.8}) == (_SUCCEEDED, _SUCCESS)

    assert arm.position("turn") == pytest.approx(1.0, abs=0.05)
    assert arm.position("lift") == pytest.approx(0.8, abs=0.05)
    arm.close()


def test_a_joint_that_leaves_its_path_fails_the_motion(gazebo: Gazebo, graph: NodeGraph) -> None:
    """Gravity pulls the slack boom farther from its path than the controller's constraints allow."""
    arm = _PlannedArm(gazebo, graph, _SLACK, {"lift": {"trajectory": 0.1}})

    assert arm.run({"turn": 0.5, "lift": 0.0}) == (_ABORTED, _CONTROL_FAILED)

    assert arm.said("Controller 'controller' failed with error PATH_TOLERANCE_VIOLATED: lift path error 0.1")
    arm.close()


def test_a_goal_that_is_not_reached_in_its_time_fails_the_motion(gazebo: Gazebo, graph: NodeGraph) -> None:
    arm = _PlannedArm(gazebo, graph, _SLACK, {"goal_time": 0.3, "lift": {"goal": 0.05}})

    assert arm.run({"turn": 0.5, "lift": 0.0}) == (_ABORTED, _CONTROL_FAILED)

    assert arm.said("Controller 'controller' failed with error GOAL_TOLERANCE_VIOLATED: lift goal error 0.")
    arm.close()


def test_a_cancelled_goal_stops_the_arm_on_its_way(gazebo: Gazebo, graph: NodeGraph) -> None:
    arm = _PlannedArm(gazebo, graph, _STIFF, {})
    arm.send({"turn": 2.5, "lift": 0.5}, speed=0.1)
    graph.until(lambda: arm.position("turn") > 0.1)

    arm.cancel()
    graph.until(lambda: arm.results)

    assert arm.ended() == (_PREEMPTED, _CANCELLED)
    gazebo.until_s(gazebo.time_s + 0.5)
    stopped = arm.position("turn")
    gazebo.until_s(gazebo.time_s + 1.0)
    assert arm.position("turn") == pytest.approx(stopped, abs=0.005)
    assert stopped < 2.0
    arm.close()


@pytest.mark.slow
def test_a_wall_that_appears_on_the_way_is_planned_around(gazebo: Gazebo, graph: NodeGraph) -> None:
    arm = _PlannedArm(gazebo, graph, _STIFF, {})
    arm.send({"turn": 2.5, "lift": 0.0}, speed=0.25, replan=True, replan_attempts=3)
    graph.until(lambda: arm.position("turn") > 0.1)

    wall = box("wall", 0.0, 0.5, 0.35, (0.05, 0.5, 0.7))
    wall["header"]["frame_id"] = "world"
    scene = {"is_diff": True, "robot_state": {"is_diff": True}, "world": {"collision_objects": [wall]}}
    assert graph.call("/r/apply_planning_scene", "moveit_msgs/ApplyPlanningScene", scene=scene).success
    highest = 0.0
    while not arm.results:
        highest = max(highest, arm.position("lift"))

    assert arm.ended() == (_SUCCEEDED, _SUCCESS)
    assert highest > 0.6, "the boom has to rise over the wall"
    assert arm.position("turn") == pytest.approx(2.5, abs=0.05)
    arm.close()
