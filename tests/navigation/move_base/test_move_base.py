"""move_base on a graph, with a map, a scan and a robot that stands."""

import math
from typing import Any

import numpy as np
import pytest

from trundle.ros import Message, StaticTransformBroadcaster, Transform

_SIZE, _RESOLUTION_M = 40, 0.1
_COSTMAP = {"robot_radius": 0.2, "robot_base_frame": "base_link", "transform_tolerance": 5.0, "update_frequency": 20.0}
_SCAN = {"data_type": "LaserScan", "marking": True, "clearing": True, "topic": "/scan"}
_STATIC = {"name": "static", "type": "costmap_2d::StaticLayer"}
_OBSTACLES = {"name": "obstacles", "type": "costmap_2d::ObstacleLayer"}
_INFLATION = {"name": "inflation", "type": "costmap_2d::InflationLayer"}


def parameters(**own: Any) -> dict[str, Any]:
    layers = {
        "obstacles": {"observation_sources": "scan", "scan": _SCAN},
        "inflation": {"inflation_radius": 0.3},
        "publish_frequency": 20.0,
        **_COSTMAP,
    }
    local = {"global_frame": "map", "rolling_window": True, "width": 2.0, "height": 2.0, "resolution": _RESOLUTION_M}
    return {
        "global_costmap": {"plugins": [_STATIC, _OBSTACLES, _INFLATION], **layers},
        "local_costmap": {"plugins": [_OBSTACLES, _INFLATION], **layers, **local},
        "planner_patience": 0.0,
        "recovery_behavior_enabled": False,
        **own,
    }


def map_fields() -> dict[str, Any]:
    """Return a map of 4 m with a wall at x = 3, whose other side cannot be reached."""
    cells = np.zeros((_SIZE, _SIZE), np.int8)
    cells[:, 30] = 100
    info = {"resolution": _RESOLUTION_M, "width": _SIZE, "height": _SIZE, "origin": {"orientation": {"w": 1.0}}}
    return {"header": {"frame_id": "map"}, "info": info, "data": cells.reshape(-1)}


def start(graph: Any, *, name: str = "move_base", ends: bool = False, **own: Any) -> Any:
    """Start move_base with the robot at 1.05, 1.05, and wait until it takes goals, unless it ends before."""
    graph.set_params({f"/{name}": parameters(**own)})
    graph.advertise("/map", "nav_msgs/OccupancyGrid", latch=True).publish(map_fields())
    broadcaster = StaticTransformBroadcaster(graph.client)
    broadcaster.send_transform(Transform(parent="map", child="base_link", stamp_ns=0, translation=(1.05, 1.05, 0.0)))
    running = graph.start("move_base/move_base", name=name)
    if ends:
        return running
    statuses = graph.listen("/move_base/status", "actionlib_msgs/GoalStatusArray")
    graph.until(lambda: statuses)
    return running


def stamped_pose(x: float, y: float, w: float = 1.0) -> dict[str, Any]:
    return {"header": {"frame_id": "map"}, "pose": {"position": {"x": x, "y": y}, "orientation": {"w": w}}}


def _drive_to(graph: Any, target: dict[str, Any]) -> Message:
    """Send a goal of the action; return its result."""
    results = graph.listen("/move_base/result", "move_base_msgs/MoveBaseActionResult")
    goals = graph.advertise("/move_base/goal", "move_base_msgs/MoveBaseActionGoal")
    graph.until(lambda: graph.connected("/move_base/result"))
    goals.publish({"goal": {"target_pose": target}})
    graph.until(lambda: results)
    return results[0]


def test_a_scan_marks_its_obstacles_and_frees_the_way_to_them(graph: Any) -> None:
    """100 lethal, 99 inscribed, 0 free, as costmap_2d translates costs."""
    start(graph)
    grids = graph.listen("/move_base/local_costmap/costmap", "nav_msgs/OccupancyGrid")
    updates = graph.listen("/move_base/local_costmap/costmap_updates", "map_msgs/OccupancyGridUpdate")
    scans = graph.advertise("/scan", "sensor_msgs/LaserScan")
    scan = {"angle_increment": math.pi, "range_min": 0.1, "range_max": 5.0}

    def cell(x: float, y: float) -> int:
        update = updates[-1]
        column, row = (int((value - low) / _RESOLUTION_M) for value, low in zip((x, y), origin, strict=True))
        return int(update.data[(row - update.y) * update.width + column - update.x])

    scans.publish({"header": {"frame_id": "base_link"}, **scan, "ranges": np.array([0.6], np.float32)})
    graph.until(lambda: grids and updates)
    origin = (grids[-1].info.origin.position.x, grids[-1].info.origin.position.y)
    graph.until(lambda: cell(1.65, 1.05) == 100)
    assert cell(1.55, 1.05) == 99
    assert cell(1.25, 1.05) == 0

    scans.publish({"header": {"frame_id": "base_link"}, **scan, "ranges": np.array([0.9], np.float32)})
    graph.until(lambda: cell(1.95, 1.05) == 100 and cell(1.65, 1.05) < 99)


def test_make_plan_leads_to_the_goal_or_as_near_as_the_tolerance_allows(graph: Any) -> None:
    start(graph)

    plan = graph.call("/move_base/make_plan", "nav_msgs/GetPlan", goal=stamped_pose(2.0, 2.0)).plan
    beyond = graph.call("/move_base/make_plan", "nav_msgs/GetPlan", goal=stamped_pose(3.5, 1.0)).plan
    near = graph.call("/move_base/make_plan", "nav_msgs/GetPlan", goal=stamped_pose(3.5, 1.0), tolerance=1.0).plan

    assert (plan.poses[0].pose.position.x, plan.poses[-1].pose.position.x) == pytest.approx((1.05, 2.0))
    assert plan.header.frame_id == "map"
    assert len(beyond.poses) == 0
    assert near.poses[-1].pose.position.x == pytest.approx(3.5)
    assert near.poses[-2].pose.position.x < 3.0


def test_obstacles_stay_until_the_costmaps_are_cleared(graph: Any) -> None:
    start(graph)
    grids = graph.listen("/move_base/global_costmap/costmap", "nav_msgs/OccupancyGrid")
    updates = graph.listen("/move_base/global_costmap/costmap_updates", "map_msgs/OccupancyGridUpdate")
    scans = graph.advertise("/scan", "sensor_msgs/LaserScan")
    cells: dict[str, Any] = {}

    def is_marked() -> bool:
        """Return True if the cell at 1.65, 1.05 is lethal, after all updates."""
        if "grid" not in cells:
            cells["grid"] = grids[-1].data.reshape(_SIZE, _SIZE).copy()
        for update in updates:
            part = (slice(update.y, update.y + update.height), slice(update.x, update.x + update.width))
            cells["grid"][part] = update.data.reshape(update.height, update.width)
        updates.clear()
        return bool(cells["grid"][10, 16] == 100)

    graph.until(lambda: grids)
    scan = {"angle_increment": math.pi, "range_min": 0.1, "range_max": 5.0, "ranges": np.array([0.6], np.float32)}
    scans.publish({"header": {"frame_id": "base_link"}, **scan})
    graph.until(is_marked)
    graph.call("/move_base/clear_costmaps", "std_srvs/Empty")

    graph.until(lambda: not is_marked())


def test_a_goal_latched_before_the_start_is_driven_to(graph: Any) -> None:
    """As rostopic pub -1 latches it."""
    graph.advertise("/move_base_simple/goal", "geometry_msgs/PoseStamped", latch=True).publish(stamped_pose(2.0, 1.0))
    goals = graph.listen("/move_base/current_goal", "geometry_msgs/PoseStamped")

    start(graph)

    graph.until(lambda: goals)
    assert goals[0].pose.position.x == pytest.approx(2.0)


def test_recovery_behaviors_run_in_order_before_a_goal_is_given_up(graph: Any) -> None:
    start(graph, recovery_behavior_enabled=True, clearing_rotation_allowed=False)
    statuses = graph.listen("/move_base/recovery_status", "move_base_msgs/RecoveryStatus")
    graph.until(lambda: graph.connected("/move_base/recovery_status"))

    result = _drive_to(graph, stamped_pose(3.5, 1.0))

    assert result.status.status == 4
    steps = [(status.current_recovery_number, status.recovery_behavior_name) for status in statuses]
    assert steps == [(0, "conservative_reset"), (1, "aggressive_reset")]
    assert {status.total_number_of_recoveries for status in statuses} == {2}


def test_a_scan_may_be_missing_no_longer_than_expected(graph: Any) -> None:
    """Without data, the robot is not driven."""
    late = {"observation_sources": "scan", "scan": {**_SCAN, "expected_update_rate": 0.01}}
    local = {**parameters()["local_costmap"], "obstacles": late}
    start(graph, local_costmap=local)
    commands = graph.listen("/cmd_vel", "geometry_msgs/Twist")
    goals = graph.advertise("/move_base_simple/goal", "geometry_msgs/PoseStamped")
    graph.until(lambda: graph.connected("/cmd_vel"))

    goals.publish(stamped_pose(2.0, 1.0))

    graph.until(lambda: len(commands) > 5)
    assert not any(command.linear.x or command.angular.z for command in commands)


@pytest.mark.parametrize(
    ("name", "error"),
    [
        ("base_local_planner", "no local planner 'teb'; there are: "),
        ("base_global_planner", "no global planner 'teb'; there are: carrot_planner/CarrotPlanner, "),
    ],
)
def test_an_unknown_planner_ends_the_node_with_the_names_of_those_that_exist(
    graph: Any, name: str, error: str, capfd: pytest.CaptureFixture[str]
) -> None:
    graph.set_params({"/move_base": parameters(**{name: "teb"})})
    graph.advertise("/map", "nav_msgs/OccupancyGrid", latch=True).publish(map_fields())
    broadcaster = StaticTransformBroadcaster(graph.client)
    broadcaster.send_transform(Transform(parent="map", child="base_link", stamp_ns=0))

    assert graph.start("move_base/move_base").result(30.0) == 1
    assert error in capfd.readouterr().err


@pytest.mark.parametrize("planner", ["global_planner/GlobalPlanner", "carrot_planner/CarrotPlanner"])
def test_other_global_planners_lead_to_the_goal(graph: Any, planner: str) -> None:
    start(graph, base_global_planner=planner)

    plan = graph.call("/move_base/make_plan", "nav_msgs/GetPlan", goal=stamped_pose(2.0, 2.0)).plan

    assert (plan.poses[-1].pose.position.x, plan.poses[-1].pose.position.y) == pytest.approx((2.0, 2.0))


def test_a_carrot_ends_before_a_wall(graph: Any) -> None:
    start(graph, base_global_planner="carrot_planner/CarrotPlanner")

    plan = graph.call("/move_base/make_plan", "nav_msgs/GetPlan", goal=stamped_pose(3.0, 1.05)).plan

    assert 2.6 < plan.poses[-1].pose.position.x < 2.9


def test_a_goal_behind_a_wall_is_aborted(graph: Any) -> None:
    start(graph)

    result = _drive_to(graph, stamped_pose(3.5, 1.0))

    assert result.status.status == 4
    assert result.status.text == "Failed to find a valid plan. Even after executing recovery behaviors."


def test_a_goal_where_the_robot_stands_is_reached_at_once(graph: Any) -> None:
    """The action is move_base, whatever the node's name."""
    start(graph, name="move_base_node")

    result = _drive_to(graph, stamped_pose(1.05, 1.05))

    assert (result.status.status, result.status.text) == (3, "Goal reached.")


def test_a_goal_without_orientation_is_refused(graph: Any) -> None:
    start(graph)

    result = _drive_to(graph, stamped_pose(2.0, 2.0, w=0.0))

    assert result.status.text == "Aborting on goal because it was sent with an invalid quaternion"


@pytest.mark.parametrize("planner", ["dwa_local_planner/DWAPlannerROS", "base_local_planner/TrajectoryPlannerROS"])
def test_a_simple_goal_makes_the_robot_turn_toward_a_way_behind_it(graph: Any, planner: str) -> None:
    name = planner.rpartition("/")[2]
    limits: dict[str, Any] = {name: {"holonomic_robot": False, "max_vel_y": 0.0, "min_vel_y": 0.0}}
    start(graph, base_local_planner=planner, **limits)
    commands = graph.listen("/cmd_vel", "geometry_msgs/Twist")
    goals = graph.advertise("/move_base_simple/goal", "geometry_msgs/PoseStamped")
    graph.until(lambda: graph.connected("/cmd_vel"))

    goals.publish(stamped_pose(0.5, 1.3))

    graph.until(lambda: any(command.angular.z for command in commands))
    turns = [command for command in commands if command.angular.z]
    assert turns[0].linear.x == 0.0
    assert turns[0].angular.z >= 0.4
