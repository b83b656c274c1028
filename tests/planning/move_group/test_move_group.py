"""move_group's actions and services, on a graph with an arm and fake controllers."""

import math
from typing import Any

import numpy as np
import pytest
from tests.planning.arms import FOLDER, arm
from tests.planning.move_group.arm_graph import ARM, add, box, joint_goal, request, send, start_arm

from trundle.planning.kinematics import Kinematics

_AWAY = {"joint_1": 0.9, "joint_2": 0.3, "joint_3": -0.4, "joint_4": 0.0, "joint_5": 0.5, "joint_6": 0.2}
_SUCCESS, _NO_IK, _NO_PLAN, _NO_GROUP, _NO_FRAME, _CONTROL_FAILED = 1, -31, -1, -15, -21, -4
_PLAN, _MOVE = "moveit_msgs/GetMotionPlan", "moveit_msgs/MoveGroup"


def _positions(graph: Any) -> dict[str, float]:
    states = graph.listen("/joint_states", "sensor_msgs/JointState")
    graph.until(lambda: len(states) > 1)
    return dict(zip(states[-1].name, states[-1].position, strict=True))


def test_a_motion_to_joint_positions_is_planned_and_executed(graph: Any) -> None:
    start_arm(graph)

    result = send(graph, "move_group", _MOVE, {"request": request(joint_goal(_AWAY)), "planning_options": {}})

    assert result.result.error_code.val == _SUCCESS
    assert result.status.text == "Solution was found and executed."
    trajectory = result.result.planned_trajectory.joint_trajectory
    assert list(trajectory.joint_names) == ARM
    np.testing.assert_allclose(trajectory.points[-1].positions, list(_AWAY.values()), atol=2e-3)
    reached = _positions(graph)
    np.testing.assert_allclose([reached[name] for name in ARM], list(_AWAY.values()), atol=2e-3)


def test_a_plan_keeps_limits_and_is_free_of_the_object_in_its_way(graph: Any) -> None:
    """The straight way of joint 1 leads through the post; every point of the plan is checked against it."""
    start_arm(graph)
    add(graph, box("post", 0.4, 0.0, 0.6, (0.05, 0.05, 1.2)))
    turned = {**dict.fromkeys(ARM, 0.0), "joint_5": 0.8}
    start = {"joint_state": {"name": ARM, "position": [-0.9, *list(turned.values())[1:]]}, "is_diff": True}
    wanted = {**request(joint_goal({**turned, "joint_1": 0.9})), "start_state": start}

    answer = graph.call("/plan_kinematic_path", _PLAN, motion_plan_request=wanted).motion_plan_response

    assert answer.error_code.val == _SUCCESS
    points = answer.trajectory.joint_trajectory.points
    validity = "moveit_msgs/GetStateValidity"
    middle = {"joint_state": {"name": ARM, "position": [0.0, *list(turned.values())[1:]]}, "is_diff": True}
    blocked = graph.call("/check_state_validity", validity, robot_state=middle, group_name="arm")
    assert not blocked.valid
    assert "post" in {blocked.contacts[0].contact_body_1, blocked.contacts[0].contact_body_2}
    for point in points:
        state = {"joint_state": {"name": ARM, "position": list(point.positions)}, "is_diff": True}
        assert graph.call("/check_state_validity", validity, robot_state=state, group_name="arm").valid
    velocities = np.array([point.velocities for point in points])
    limits = arm("six_axis").max_velocity[arm("six_axis").indices(ARM)]
    assert np.all(np.abs(velocities) <= limits * 1.001)


def test_a_display_that_comes_later_shows_the_last_plan(graph: Any) -> None:
    """As in MoveIt, which latches display_planned_path."""
    start_arm(graph)
    wanted = request(joint_goal(_AWAY))
    answer = graph.call("/plan_kinematic_path", _PLAN, motion_plan_request=wanted).motion_plan_response

    shown = graph.listen("/move_group/display_planned_path", "moveit_msgs/DisplayTrajectory")
    graph.until(lambda: shown)

    points = [[tuple(point.positions) for point in one.joint_trajectory.points] for one in shown[0].trajectory]
    assert points == [[tuple(point.positions) for point in answer.trajectory.joint_trajectory.points]]


def test_requests_that_cannot_be_planned_have_their_codes(graph: Any) -> None:
    start_arm(graph)
    add(graph, box("wall", 0.35, 0.35, 0.5, (0.3, 0.3, 1.2)))

    def code(wanted: dict[str, Any]) -> int:
        answer = graph.call("/plan_kinematic_path", _PLAN, motion_plan_request=wanted)
        return int(answer.motion_plan_response.error_code.val)

    assert code(request(joint_goal(_AWAY), group="leg")) == _NO_GROUP
    assert code(request(joint_goal({**_AWAY, "joint_1": math.pi / 4}))) == _NO_PLAN
    somewhere = {"header": {"frame_id": "nowhere"}, "link_name": "tool0", "orientation": {"w": 1.0}}
    assert code(request({"orientation_constraints": [somewhere]})) == _NO_FRAME


def test_the_other_way_round_kinematics_returns_the_pose(graph: Any) -> None:
    start_arm(graph)
    kinematics = Kinematics(arm("six_axis"))
    state = arm("six_axis").state_of(_AWAY)
    x, y, z = kinematics.link_pose(state, "tool0").position
    w, qx, qy, qz = kinematics.link_pose(state, "tool0").quaternion
    pose = {"position": {"x": x, "y": y, "z": z}, "orientation": {"x": qx, "y": qy, "z": qz, "w": w}}

    asked = {"group_name": "arm", "pose_stamped": {"header": {"frame_id": "base_link"}, "pose": pose}}
    solved = graph.call("/compute_ik", "moveit_msgs/GetPositionIK", ik_request={**asked, "avoid_collisions": True})
    found = solved.solution
    back = graph.call("/compute_fk", "moveit_msgs/GetPositionFK", fk_link_names=["tool0", "elbow"], robot_state=found)

    assert solved.error_code.val == _SUCCESS
    assert list(back.fk_link_names) == ["tool0"]
    assert back.error_code.val == -18  # there is no elbow
    p = back.pose_stamped[0].pose.position
    np.testing.assert_allclose([p.x, p.y, p.z], [x, y, z], atol=1e-4)
    far = {**pose, "position": {"x": 5.0}}
    asked["pose_stamped"] = {"header": {"frame_id": "base_link"}, "pose": far}
    assert graph.call("/compute_ik", "moveit_msgs/GetPositionIK", ik_request=asked).error_code.val == _NO_IK


def test_a_cartesian_path_ends_where_an_object_is(graph: Any) -> None:
    start_arm(graph)
    model = arm("six_axis")
    home = model.state_of(dict.fromkeys(ARM, 0.0) | {"joint_5": 0.8})
    pose = Kinematics(model).link_pose(home, "tool0")
    x, y, z = pose.position
    w, qx, qy, qz = pose.quaternion
    down = {"position": {"x": x, "y": y, "z": z - 0.2}, "orientation": {"x": qx, "y": qy, "z": qz, "w": w}}
    asked: dict[str, Any] = {"group_name": "arm", "link_name": "tool0", "max_step": 0.01, "avoid_collisions": True}
    asked |= {"waypoints": [down], "start_state": {"is_diff": True}}

    free = graph.call("/compute_cartesian_path", "moveit_msgs/GetCartesianPath", **asked)
    add(graph, box("floor", x, y, z - 0.25, (0.5, 0.5, 0.1)))
    blocked = graph.call("/compute_cartesian_path", "moveit_msgs/GetCartesianPath", **asked)

    assert free.fraction == 1.0
    assert len(free.solution.joint_trajectory.points) >= 20
    assert 0.0 < blocked.fraction < 1.0


@pytest.mark.parametrize("adapter", ["AddTimeParameterization", "AddTimeOptimalParameterization"])
def test_a_joint_that_turns_without_end_goes_the_short_way(graph: Any, adapter: str) -> None:
    wrist = '<joint name="joint_6" type="{}">'
    adapters = f"default_planner_request_adapters/{adapter}"
    start_arm(graph, replaced=(wrist.format("revolute"), wrist.format("continuous")), request_adapters=adapters)
    home = _positions(graph)
    start = {"joint_state": {"name": ["joint_6"], "position": [3.0]}, "is_diff": True}
    ask = {**request(joint_goal({**{name: home[name] for name in ARM}, "joint_6": -3.0})), "start_state": start}

    answer = graph.call("/plan_kinematic_path", _PLAN, motion_plan_request=ask).motion_plan_response

    assert answer.error_code.val == _SUCCESS
    turned = np.array([point.positions[5] for point in answer.trajectory.joint_trajectory.points])
    assert np.ptp(turned) == pytest.approx(2.0 * math.pi - 6.0, abs=0.02)


def test_a_base_on_the_floor_is_planned_with_its_arm_but_not_driven(
    graph: Any, capfd: pytest.CaptureFixture[str]
) -> None:
    """A planar joint's way is a multi_dof_joint_trajectory, which no controller takes."""
    srdf = (FOLDER / "six_axis.srdf").read_text().replace('type="fixed" parent', 'type="planar" parent')
    whole = '<group name="whole"><joint name="fixed_base"/><group name="arm"/></group></robot>'
    start_arm(graph, srdf=srdf.replace("</robot>", whole))
    home = _positions(graph)
    wanted = {**{name: home[name] for name in ARM}, "joint_1": 0.5, "fixed_base/x": 1.0, "fixed_base/theta": 0.5}
    ask = request(joint_goal(wanted), group="whole")

    result = send(graph, "move_group", _MOVE, {"request": ask, "planning_options": {}})

    assert result.result.error_code.val == _CONTROL_FAILED
    assert "no controller takes trajectories of planar and floating joints: fixed_base" in capfd.readouterr().err
    trajectory = result.result.planned_trajectory
    assert list(trajectory.joint_trajectory.joint_names) == ARM
    assert list(trajectory.multi_dof_joint_trajectory.joint_names) == ["fixed_base"]
    first, last = (trajectory.multi_dof_joint_trajectory.points[index].transforms[0] for index in (0, -1))
    assert first.translation.x == 0.0
    assert last.translation.x == pytest.approx(1.0, abs=2e-3)
    assert 2.0 * math.atan2(last.rotation.z, last.rotation.w) == pytest.approx(0.5, abs=2e-3)


def test_planners_are_listed_with_their_settings(graph: Any) -> None:
    configs = {"RRTConnect": {"type": "geometric::RRTConnect", "range": 0.5}}
    start_arm(graph, planner_configs=configs, arm={"default_planner_config": "RRTConnect"})

    listed = graph.call("/query_planner_interface", "moveit_msgs/QueryPlannerInterfaces").planner_interfaces
    params = {"keys": ["range"], "values": ["0.7"]}
    graph.call("/set_planner_params", "moveit_msgs/SetPlannerParams", planner_config="RRTConnect", params=params)
    found = graph.call("/get_planner_params", "moveit_msgs/GetPlannerParams", planner_config="RRTConnect").params

    assert listed[0].name == "OMPL"
    assert "RRTConnect" in listed[0].planner_ids
    assert dict(zip(found.keys, found.values, strict=True)) == {"type": "geometric::RRTConnect", "range": "0.7"}


def test_optimizing_planners_are_answered_by_another_which_is_said(
    graph: Any, capfd: pytest.CaptureFixture[str]
) -> None:
    """As panda's launch files load them: pipelines of OMPL, CHOMP, STOMP and TrajOpt, and an adapter of CHOMP's."""
    plugins = {
        "ompl": "ompl_interface/OMPLPlanner",
        "chomp": "chomp_interface/CHOMPPlanner",
        "stomp": "stomp_moveit/StompPlannerManager",
        "trajopt": "trajopt_interface/TrajOptPlanner",
    }
    pipelines: dict[str, Any] = {name: {"planning_plugin": plugin} for name, plugin in plugins.items()}
    pipelines["chomp"]["request_adapters"] = (
        "default_planner_request_adapters/FixWorkspaceBounds chomp/OptimizerAdapter"
    )
    start_arm(graph, planning_pipelines=pipelines, default_planning_pipeline="chomp")
    ask = {**request(joint_goal({**_positions(graph), "joint_1": 0.5})), "pipeline_id": "stomp"}

    answer = graph.call("/plan_kinematic_path", _PLAN, motion_plan_request=ask).motion_plan_response
    listed = graph.call("/query_planner_interface", "moveit_msgs/QueryPlannerInterfaces").planner_interfaces

    assert answer.error_code.val == _SUCCESS
    assert {one.pipeline_id: one.name for one in listed}["trajopt"] == "TrajOpt"
    assert {one.pipeline_id: list(one.planner_ids) for one in listed}["chomp"] == ["CHOMP"]
    printed = capfd.readouterr().err
    assert "[WARN]" in next(line for line in printed.splitlines() if "there is no chomp_interface/CHOMPPlanner" in line)
    assert "there is no planning request adapter chomp/OptimizerAdapter; paths are planned without it" in printed
    assert "there is no STOMP; RRTConnect planned, which answers the same requests" in printed


def test_a_straight_line_keeps_the_cartesian_limits_of_the_parameters(graph: Any) -> None:
    limits = {"max_trans_vel": 0.02, "max_trans_acc": 2.25, "max_trans_dec": -5.0, "max_rot_vel": 1.57}
    start_arm(graph, planning_plugin="pilz_industrial_motion_planner::CommandPlanner", cartesian_limits=limits)
    home = _positions(graph)
    wanted = {name: home[name] + (0.1 if name == "joint_2" else 0.0) for name in ARM}

    ask = {**request(joint_goal(wanted)), "planner_id": "LIN"}
    answer = graph.call("/plan_kinematic_path", _PLAN, motion_plan_request=ask).motion_plan_response

    assert answer.error_code.val == _SUCCESS
    points = answer.trajectory.joint_trajectory.points
    model = arm("six_axis")
    states = np.zeros((len(points), len(model.variables)))
    states[:, model.indices(ARM)] = [point.positions for point in points]
    row = list(model.links).index(model.groups["arm"].tips[0])
    places = Kinematics(model).link_poses(states)[:, row, :3]
    times = np.array([point.time_from_start.sec + 1e-9 * point.time_from_start.nanosec for point in points])
    speeds = np.linalg.norm(np.diff(places, axis=0), axis=1) / np.diff(times)
    assert 0.019 < speeds.max() < 0.0201


def test_a_path_constraint_without_a_link_of_the_robot_is_left_out_with_a_warning(graph: Any) -> None:
    """As in MoveIt; the example of Kinova's arms has one without a link."""
    start_arm(graph)
    lines = graph.listen("/rosout_agg", "rosgraph_msgs/Log")
    unknown = {
        "orientation_constraints": [{"orientation": {"w": 1.0}}],
        "position_constraints": [{"header": {"frame_id": "base_link"}, "link_name": "tail"}],
        "joint_constraints": [{"joint_name": "joint_9", "position": 9.0}],
    }
    wanted = {**request(joint_goal(_AWAY)), "path_constraints": unknown}

    answer = graph.call("/plan_kinematic_path", _PLAN, motion_plan_request=wanted).motion_plan_response
    state = graph.call(
        "/check_state_validity", "moveit_msgs/GetStateValidity", robot_state={"is_diff": True}, constraints=unknown
    )

    assert answer.error_code.val == _SUCCESS
    assert state.valid
    graph.until(lambda: len([line for line in lines if "Constraint invalid." in line.msg]) == 6)
    assert {line.msg for line in lines if "Constraint invalid." in line.msg} == {
        "Could not find link model for link name ''. Constraint invalid.",
        "Position constraint link model tail not found in kinematic model. Constraint invalid.",
        "Joint 'joint_9' not found in model 'six_axis'. Constraint invalid.",
    }
