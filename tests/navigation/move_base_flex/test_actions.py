"""mbf_costmap_nav on a graph, with a map, and a robot that follows cmd_vel."""

import math
from typing import Any

import numpy as np
import pytest
from tests.navigation.move_base.test_move_base import map_fields, parameters, stamped_pose

from trundle.ros import Message, StaticTransformBroadcaster, Transform

_DWA = {"max_vel_y": 0.0, "min_vel_y": 0.0, "vy_samples": 0}


def _start(graph: Any, **own: Any) -> None:
    """Start the node with the robot at 1.05, 1.05, and wait until it takes goals."""
    plugins = {
        "planners": [{"name": "navfn", "type": "navfn/NavfnROS"}],
        "controllers": [
            {"name": "dwa", "type": "dwa_local_planner/DWAPlannerROS"},
            {"name": "teb", "type": "teb_local_planner/TebLocalPlannerROS"},
        ],
        "recovery_behaviors": [{"name": "clear", "type": "clear_costmap_recovery/ClearCostmapRecovery"}],
        "dwa": _DWA,
    }
    graph.set_params({"/move_base_flex": parameters(**{**plugins, "planner_patience": 0.1, **own})})
    graph.advertise("/map", "nav_msgs/OccupancyGrid", latch=True).publish(map_fields())
    broadcaster = StaticTransformBroadcaster(graph.client)
    broadcaster.send_transform(Transform(parent="map", child="base_link", stamp_ns=0, translation=(1.05, 1.05, 0.0)))
    graph.start("mbf_costmap_nav/mbf_costmap_nav", name="move_base_flex")
    statuses = graph.listen("/move_base_flex/move_base/status", "actionlib_msgs/GoalStatusArray")
    graph.until(lambda: statuses)


def _send(graph: Any, action: str, kind: str, *sent: dict[str, Any], cancels: bool = False) -> list[Message]:
    """Send goals one after the other; return their results."""
    base = f"/move_base_flex/{action}"
    results = graph.listen(f"{base}/result", f"mbf_msgs/{kind}ActionResult")
    goals = graph.advertise(f"{base}/goal", f"mbf_msgs/{kind}ActionGoal")
    graph.until(lambda: graph.connected(f"{base}/result"))
    commands = graph.listen("/cmd_vel", "geometry_msgs/Twist")
    for number, goal in enumerate(sent, 1):
        goals.publish({"goal": goal})
        if cancels:
            graph.until(lambda: any(command.angular.z or command.linear.x for command in commands))
            graph.advertise(f"{base}/cancel", "actionlib_msgs/GoalID").publish({})
        graph.until(lambda number=number: len(results) == number)
    return results


def _path(*points: tuple[float, float]) -> dict[str, Any]:
    return {"header": {"frame_id": "map"}, "poses": [stamped_pose(x, y) for x, y in points]}


def test_a_path_is_found_with_its_length(graph: Any) -> None:
    _start(graph)

    (result,) = _send(graph, "get_path", "GetPath", {"target_pose": stamped_pose(2.05, 1.05)})

    assert (result.status.status, result.result.outcome) == (3, 0)
    assert result.result.cost == pytest.approx(1.0, abs=0.01)
    ends = [result.result.path.poses[i].pose.position.x for i in (0, -1)]
    assert ends == pytest.approx([1.05, 2.05])


@pytest.mark.parametrize(
    ("goal", "outcome"),
    [
        ({"target_pose": stamped_pose(3.5, 1.0)}, 54),
        ({"target_pose": stamped_pose(9.0, 1.0)}, 61),
        ({"target_pose": stamped_pose(2.0, 1.0), "planner": "sbpl"}, 59),
        ({"target_pose": {**stamped_pose(2.0, 1.0), "header": {"frame_id": "moon"}}}, 57),
        ({"target_pose": stamped_pose(math.nan, 1.0)}, 57),
    ],
)
def test_a_path_that_there_is_not_has_a_result_code(graph: Any, goal: dict[str, Any], outcome: int) -> None:
    _start(graph)

    (result,) = _send(graph, "get_path", "GetPath", goal)

    assert (result.status.status, result.result.outcome) == (4, outcome)
    assert result.result.message


def test_a_path_that_ends_at_the_robot_is_done(graph: Any) -> None:
    _start(graph)

    (result,) = _send(graph, "exe_path", "ExePath", {"path": _path((1.0, 1.05), (1.05, 1.05)), "controller": "dwa"})

    assert (result.status.status, result.result.outcome) == (3, 0)
    assert result.result.dist_to_goal == pytest.approx(0.0, abs=1e-6)
    assert result.result.final_pose.pose.position.x == pytest.approx(1.05)


@pytest.mark.parametrize("controller", ["dwa", "teb"])
def test_a_path_is_driven_until_it_is_canceled(graph: Any, controller: str) -> None:
    _start(graph, teb={"min_obstacle_dist": 0.1})
    points = [(float(x), 1.05) for x in np.linspace(1.05, 2.5, 30)]

    (result,) = _send(graph, "exe_path", "ExePath", {"path": _path(*points), "controller": controller}, cancels=True)

    assert (result.status.status, result.result.outcome) == (2, 101)
    assert result.result.dist_to_goal == pytest.approx(1.45)


@pytest.mark.parametrize(
    ("goal", "outcome"), [({"path": _path()}, 110), ({"path": _path((1.0, 1.0)), "controller": "pid"}, 113)]
)
def test_a_path_that_cannot_be_driven_has_a_result_code(graph: Any, goal: dict[str, Any], outcome: int) -> None:
    _start(graph)

    assert _send(graph, "exe_path", "ExePath", goal)[0].result.outcome == outcome


def test_recovery_behaviors_run_by_their_names(graph: Any) -> None:
    _start(graph)

    done, missing = _send(graph, "recovery", "Recovery", {"behavior": "clear"}, {"behavior": "dance"})

    assert (done.result.outcome, done.result.used_plugin) == (0, "clear")
    assert missing.result.outcome == 155
    assert "there are: clear" in missing.result.message


def test_move_base_gives_up_a_goal_behind_a_wall(graph: Any) -> None:
    _start(graph, recovery_enabled=False)

    goals = [{"target_pose": stamped_pose(1.05, 1.05)}, {"target_pose": stamped_pose(3.5, 1.0)}]
    there, behind = _send(graph, "move_base", "MoveBase", *goals)

    assert (there.status.status, there.result.outcome) == (3, 0)
    assert (behind.status.status, behind.result.outcome) == (4, 54)


def test_costs_are_checked(graph: Any) -> None:
    """The wall is at x = 3, 0.1 m thick; the robot has a radius of 0.21 m."""
    _start(graph)
    space = "/move_base_flex/check"
    header = {"frame_id": "map"}

    def point(x: float, y: float) -> tuple[int, int]:
        found = graph.call(
            f"{space}_point_cost", "mbf_msgs/CheckPoint", costmap=2, point={"header": header, "point": {"x": x, "y": y}}
        )
        return found.state, found.cost

    def pose(x: float, **own: Any) -> int:
        return graph.call(f"{space}_pose_cost", "mbf_msgs/CheckPose", costmap=2, pose=stamped_pose(x, 2.0), **own).state

    assert point(3.05, 1.0) == (2, 254)
    assert point(2.85, 1.0) == (1, 253)
    assert point(1.0, 1.0) == (0, 0)
    assert point(-1.0, 1.0) == (4, 0)
    assert (pose(1.0), pose(2.9), pose(0.0)) == (0, 2, 4)
    assert (pose(2.5), pose(2.5, safety_dist=0.4)) == (0, 2)
    assert pose(9.0, current_pose=True) == 0
    path = _path(*((x, 1.0) for x in (1.0, 2.0, 2.9, 3.5)))
    checked = graph.call(f"{space}_path_cost", "mbf_msgs/CheckPath", costmap=2, path=path, return_on=2)
    assert (checked.state, checked.last_checked) == (2, 2)
    cells = graph.call(f"{space}_path_cost", "mbf_msgs/CheckPath", costmap=2, path=path, path_cells_only=True)
    assert (cells.state, cells.last_checked) == (1, 3)


def test_the_nearest_free_pose_is_found(graph: Any) -> None:
    """The wall is at x = 3, 0.1 m thick; the robot has a radius of 0.21 m, and its cells are 0.1 m long."""
    _start(graph)

    def find(x: float, **own: Any) -> Any:
        own = {"costmap": 2, "dist_tolerance": 1.0, "angle_tolerance": 0.5, "pose": stamped_pose(x, 2.05), **own}
        return graph.call("/move_base_flex/find_valid_pose", "mbf_msgs/FindValidPose", **own)

    assert (find(1.05).state, find(1.05).pose.pose.position.x) == (0, pytest.approx(1.05))
    before = find(3.0)
    assert before.state == 0
    assert 2.3 < before.pose.pose.position.x < 2.75 or 3.35 < before.pose.pose.position.x < 3.7
    assert before.pose.pose.position.y == pytest.approx(2.05, abs=0.15)
    assert before.pose.header.frame_id == "map"
    assert find(3.05, dist_tolerance=0.1).state == 2
    assert find(9.0).state == 4
    assert find(9.0, current_pose=True).pose.pose.position.x == pytest.approx(1.05)
    assert find(math.nan).state == 4


def test_missing_controllers_end_the_node_in_a_sentence(graph: Any, capfd: pytest.CaptureFixture[str]) -> None:
    values = parameters(planners=[{"name": "navfn", "type": "navfn/NavfnROS"}])
    graph.set_params({"/move_base_flex": values})
    graph.advertise("/map", "nav_msgs/OccupancyGrid", latch=True).publish(map_fields())
    broadcaster = StaticTransformBroadcaster(graph.client)
    broadcaster.send_transform(Transform(parent="map", child="base_link", stamp_ns=0))

    assert graph.start("mbf_costmap_nav/mbf_costmap_nav", name="move_base_flex").result(30.0) == 1
    assert "/move_base_flex/controllers: expected a list of plugins" in capfd.readouterr().err
