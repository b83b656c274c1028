"""rrt_exploration's nodes, alone and together."""

import time
from typing import Any

import numpy as np
import pytest
from tests.navigation.exploration.test_nodes import FakeMoveBase, grid

from trundle.navigation.exploration.rrt_filter import mean_shift
from trundle.ros import StaticTransformBroadcaster, Transform

_CORNERS = ((0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0), (0.5, 0.5))
_STATUS = "actionlib_msgs/GoalStatusArray"
_HALF_UNKNOWN = grid(np.s_[1:39, 20:39])


@pytest.fixture
def move_base(graph: Any) -> FakeMoveBase:
    static = StaticTransformBroadcaster(graph.client)
    static.send_transform(Transform(parent="map", child="base_link", translation=(0.5, 0.5, 0.0)))
    return FakeMoveBase(graph)


def _click(graph: Any) -> None:
    clicks = graph.client.advertise("/clicked_point", "geometry_msgs/PointStamped", queue_size=None)
    graph.until(lambda: clicks.has_subscribers)
    for x, y in ((float("nan"), 0.0), *_CORNERS):
        clicks.publish({"header": {"frame_id": "map"}, "point": {"x": x, "y": y}})


def test_mean_shift_finds_the_centers_of_clusters() -> None:
    random = np.random.default_rng(1)
    centers = np.array([[0.0, 0.0], [3.0, 1.0], [-2.0, 4.0]])
    sizes = (40, 20, 10)
    points = np.vstack([c + random.normal(0.0, 0.05, (n, 2)) for c, n in zip(centers, sizes, strict=True)])

    assert mean_shift(random.permutation(points), 0.5) == pytest.approx(centers, abs=0.05)
    assert mean_shift(np.array([[1.0, 2.0]]), 0.3) == pytest.approx(np.array([[1.0, 2.0]]))


@pytest.mark.parametrize("kind", ["global_rrt_detector", "local_rrt_detector"])
@pytest.mark.usefixtures("move_base")
def test_a_tree_finds_the_edge_of_known_space(graph: Any, kind: str) -> None:
    """The edge is at x = 1 m; a branch reaches it from the free side."""
    found = graph.listen("/detected_points", "geometry_msgs/PointStamped")
    graph.client.advertise("/map", "nav_msgs/OccupancyGrid", latch=True).publish(_HALF_UNKNOWN)
    graph.start(f"rrt_exploration/{kind}", eta=0.5, map_topic="/map", robot_frame="/base_link")
    _click(graph)

    graph.until(lambda: len(found) > 5)
    assert all(message.header.frame_id == "map" for message in found)
    assert [message.point.x for message in found] == pytest.approx([1.0] * len(found), abs=0.011)


@pytest.mark.usefixtures("move_base")
def test_a_tree_does_not_grow_through_walls(graph: Any) -> None:
    """All free cells are enclosed."""
    found = graph.listen("/detected_points", "geometry_msgs/PointStamped")
    shapes = graph.listen("/global_rrt_detector_shapes", "visualization_msgs/Marker")
    graph.client.advertise("/map", "nav_msgs/OccupancyGrid", latch=True).publish(grid(None))
    graph.start("rrt_exploration/global_rrt_detector", eta=5.0, map_topic="/map")
    _click(graph)

    graph.until(lambda: any(shape.type == 5 and len(shape.points) > 40 for shape in shapes))
    assert not found


@pytest.mark.usefixtures("move_base")
def test_the_filter_drops_points_in_obstacles_and_in_known_space(graph: Any) -> None:
    """Three points of one place are one; another is beside a wall of the costmap; the third has nothing to tell."""
    filtered = graph.listen("/filtered_points", "rrt_exploration/PointArray")
    costs = grid(None)
    costs["data"] = costs["data"].copy().reshape(40, 40)
    costs["data"][30:, 15:25] = 99
    costs["data"] = costs["data"].reshape(-1)
    graph.client.advertise("/map", "nav_msgs/OccupancyGrid", latch=True).publish(_HALF_UNKNOWN)
    graph.client.advertise("/costs", "nav_msgs/OccupancyGrid", latch=True).publish(costs)
    graph.start("rrt_exploration/filter.py", global_costmap_topic="/costs", info_radius=1.2)
    points = graph.advertise("/detected_points", "geometry_msgs/PointStamped")
    graph.until(lambda: graph.linked("/filtered_points"))
    for x, y in ((1.0, 0.70), (1.0, 0.74), (1.0, 0.66), (1.0, 1.7), (0.2, 0.3)):
        points.publish({"header": {"frame_id": "map"}, "point": {"x": x, "y": y}})

    graph.until(lambda: filtered and [len(filtered[-1].points)] == [1])
    point = filtered[-1].points[0]
    assert (point.x, point.y) == pytest.approx((1.0, 0.7), abs=0.02)


def test_the_assigner_drives_to_where_most_is_unknown(graph: Any, move_base: FakeMoveBase) -> None:
    graph.client.advertise("/map", "nav_msgs/OccupancyGrid", latch=True).publish(_HALF_UNKNOWN)
    points = graph.client.advertise("/filtered_points", "rrt_exploration/PointArray", latch=True)
    points.publish({"points": [{"x": 0.6, "y": 0.3}, {"x": 1.4, "y": 1.0}, {"x": float("nan"), "y": 1.0}]})
    graph.start("rrt_exploration/assigner.py", rate=20.0)

    graph.until(lambda: move_base.goals)
    assert move_base.goals[0] == pytest.approx((1.4, 1.0))


def test_a_robot_is_sent_once_to_where_nothing_becomes_known(graph: Any, move_base: FakeMoveBase) -> None:
    graph.client.advertise("/map", "nav_msgs/OccupancyGrid", latch=True).publish(_HALF_UNKNOWN)
    points = graph.client.advertise("/filtered_points", "rrt_exploration/PointArray", latch=True)
    points.publish({"points": [{"x": 0.6, "y": 0.3}, {"x": 1.4, "y": 1.0}]})
    graph.start("rrt_exploration/assigner.py", rate=20.0, delay_after_assignement=0.05)

    graph.until(lambda: len(move_base.goals) > 1)
    assert move_base.goals[:2] == [pytest.approx((1.4, 1.0)), pytest.approx((0.6, 0.3))]


def test_a_robot_drives_on_until_half_of_what_was_unknown_is_known(graph: Any) -> None:
    """The other point is nearer, and better worth from the start."""
    static = StaticTransformBroadcaster(graph.client)
    static.send_transform(Transform(parent="map", child="base_link", translation=(0.5, 0.5, 0.0)))
    goals = graph.listen("/move_base/goal", "move_base_msgs/MoveBaseActionGoal")
    graph.client.advertise("/move_base/status", _STATUS, latch=True).publish({})
    maps = graph.client.advertise("/map", "nav_msgs/OccupancyGrid", latch=True)
    maps.publish(_HALF_UNKNOWN)
    points = graph.client.advertise("/filtered_points", "rrt_exploration/PointArray", latch=True)
    points.publish({"points": [{"x": 1.5, "y": 1.5}]})
    graph.start("rrt_exploration/assigner.py", rate=20.0, delay_after_assignement=0.05, info_radius=0.3)
    graph.until(lambda: goals)

    points.publish({"points": [{"x": 1.5, "y": 1.5}, {"x": 1.4, "y": 0.5}]})
    seen = time.monotonic() + 0.5
    graph.until(lambda: time.monotonic() > seen)
    assert len(goals) == 1
    maps.publish(grid(np.s_[1:30, 20:39]))
    graph.until(lambda: len(goals) > 1)
    assert goals[1].goal.target_pose.pose.position.y == pytest.approx(0.5)


def test_two_robots_are_sent_to_different_points(graph: Any) -> None:
    static = StaticTransformBroadcaster(graph.client)
    for name, x in (("/robot_1", 0.4), ("/robot_2", 0.5)):
        static.send_transform(Transform(parent="map", child=f"{name[1:]}/base_link", translation=(x, 0.5, 0.0)))
    goals = [graph.listen(f"/robot_{n}/move_base/goal", "move_base_msgs/MoveBaseActionGoal") for n in (1, 2)]
    servers = [graph.client.advertise(f"/robot_{n}/move_base/status", _STATUS, latch=True) for n in (1, 2)]
    for server in servers:
        server.publish({})
    graph.client.advertise("/map", "nav_msgs/OccupancyGrid", latch=True).publish(_HALF_UNKNOWN)
    points = graph.client.advertise("/filtered_points", "rrt_exploration/PointArray", latch=True)
    points.publish({"points": [{"x": 1.3, "y": 0.5}, {"x": 1.3, "y": 1.5}]})
    options = {"namespace": "/robot_", "n_robots": 2, "info_radius": 0.4, "hysteresis_radius": 0.1}
    graph.start("rrt_exploration/assigner.py", rate=20.0, delay_after_assignement=0.05, **options)

    graph.until(lambda: goals[0] and goals[1])
    places = {round(messages[-1].goal.target_pose.pose.position.y, 1) for messages in goals}
    assert places == {0.5, 1.5}


@pytest.mark.usefixtures("move_base")
def test_the_detector_of_pictures_finds_the_edges_of_all_regions(graph: Any) -> None:
    """Unknown space begins at x = 1 m; a wall at y = 1 m divides the free space, and its edge."""
    fields = grid(np.s_[1:39, 20:39])
    fields["data"].reshape(40, 40)[20, :20] = 100
    found = graph.listen("/detected_points", "geometry_msgs/PointStamped")
    graph.client.advertise("/map", "nav_msgs/OccupancyGrid", latch=True).publish(fields)
    graph.start("rrt_exploration/frontier_opencv_detector.py", map_topic="/map")

    graph.until(lambda: len(found) >= 4)
    points = sorted({(round(m.point.x, 3), round(m.point.y, 2)) for m in found})
    assert [x for x, _ in points] == pytest.approx([1.025] * len(points))
    assert points[0][1] < 0.6
    assert points[-1][1] > 1.4
