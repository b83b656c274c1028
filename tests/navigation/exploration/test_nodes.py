"""explore_lite and frontier_exploration against a move_base that is everywhere at once."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from trundle.ros import ActionResult, ActionServer, StaticTransformBroadcaster, Transform

SIZE = 40


def grid(unknown: tuple[slice, slice] | None, *, frame: str = "map") -> dict[str, Any]:
    """2 m × 2 m of free cells within walls, some of them unknown."""
    cells = np.zeros((SIZE, SIZE), dtype=np.int8)
    cells[[0, -1], :] = cells[:, [0, -1]] = 100
    if unknown is not None:
        cells[unknown] = -1
    info = {"resolution": 0.05, "width": SIZE, "height": SIZE, "origin": {"orientation": {"w": 1.0}}}
    return {"header": {"frame_id": frame}, "info": info, "data": cells.reshape(-1)}


class FakeMoveBase:
    """Ends each goal as it is told to."""

    def __init__(self, graph: Any) -> None:
        self.goals: list[tuple[float, float]] = []
        self.status: Any = "succeeded"
        self._server = ActionServer(graph.client, "move_base", "move_base_msgs/MoveBase", self._execute)

    async def _execute(self, goal: Any, accept: Callable[[], None]) -> ActionResult:
        accept()
        position = goal.target_pose.pose.position
        self.goals.append((position.x, position.y))
        return ActionResult(status=self.status)


@pytest.fixture
def move_base(graph: Any) -> FakeMoveBase:
    static = StaticTransformBroadcaster(graph.client)
    static.send_transform(Transform(parent="map", child="base_link", translation=(0.5, 0.5, 0.0)))
    return FakeMoveBase(graph)


def test_explore_drives_to_the_largest_frontier_and_stops_when_all_is_known(
    graph: Any, move_base: FakeMoveBase
) -> None:
    log = graph.listen("/rosout", "rosgraph_msgs/Log")
    markers = graph.listen("/explore/frontiers", "visualization_msgs/MarkerArray")
    maps = graph.client.advertise("/map", "nav_msgs/OccupancyGrid", latch=True)
    maps.publish(grid(np.s_[1:39, 30:39]))
    params = {"costmap_topic": "map", "costmap_updates_topic": "map_updates", "planner_frequency": 20.0}
    graph.start("explore_lite/explore", visualize=True, **params)

    graph.until(lambda: move_base.goals and markers)
    assert move_base.goals[0] == pytest.approx((1.525, 1.0))
    assert len(markers[0].markers) == 2
    update = {"x": 1, "y": 1, "width": 38, "height": 38, "data": np.zeros(38 * 38, dtype=np.int8)}
    graph.client.advertise("/map_updates", "map_msgs/OccupancyGridUpdate", latch=True).publish(update)
    graph.until(lambda: any(line.msg == "Exploration stopped." for line in log))


def test_explore_leaves_a_frontier_alone_that_move_base_gives_up(graph: Any, move_base: FakeMoveBase) -> None:
    log = graph.listen("/rosout", "rosgraph_msgs/Log")
    move_base.status = "aborted"
    graph.client.advertise("/costmap", "nav_msgs/OccupancyGrid", latch=True).publish(grid(np.s_[1:39, 30:39]))
    graph.start("explore_lite/explore", planner_frequency=20.0)
    graph.until(lambda: any(line.msg == "Exploration stopped." for line in log))
    assert len(move_base.goals) == 1


def test_hostile_costmaps_are_ignored_in_a_sentence(graph: Any, move_base: FakeMoveBase) -> None:
    log = graph.listen("/rosout", "rosgraph_msgs/Log")
    maps = graph.client.advertise("/costmap", "nav_msgs/OccupancyGrid", queue_size=None)
    graph.start("explore_lite/explore", planner_frequency=20.0)
    graph.until(lambda: maps.has_subscribers)
    wild = grid(None)
    for change in ({"resolution": float("nan")}, {"width": 7}, {"origin": {"position": {"x": float("inf")}}}):
        maps.publish({**wild, "info": {**wild["info"], **change}})
        graph.until(lambda: any("a costmap is ignored" in str(line.msg) for line in log))
    assert move_base.goals == []


def test_a_clicked_boundary_is_explored(graph: Any, move_base: FakeMoveBase) -> None:
    """The right half is unknown, but only what is within the boundary is driven to."""
    results = graph.listen("/explore_server/result", "frontier_exploration/ExploreTaskActionResult")
    maps = graph.client.advertise("/map", "nav_msgs/OccupancyGrid", latch=True)
    maps.publish(grid(np.s_[1:39, 20:39]))
    layers = [
        {"name": "static", "type": "costmap_2d::StaticLayer"},
        {"name": "explore_boundary", "type": "frontier_exploration::BoundedExploreLayer"},
    ]
    costmap = {
        "plugins": layers,
        "robot_radius": 0.1,
        "track_unknown_space": True,
        "update_frequency": 20.0,
        "explore_boundary": {
            "resize_to_boundary": False,
            "frontier_travel_point": "middle",
            "explore_clear_space": False,
        },
    }
    graph.start("frontier_exploration/explore_server", frequency=20.0, explore_costmap=costmap)
    graph.start("frontier_exploration/explore_client")
    clicks = graph.advertise("/clicked_point", "geometry_msgs/PointStamped")
    graph.until(lambda: graph.linked("/explore_server/goal"))
    for x, y in ((0.2, 0.2), (1.8, 0.2), (1.8, 0.8), (0.2, 0.8), (0.21, 0.21), (0.5, 0.5)):
        clicks.publish({"header": {"frame_id": "map"}, "point": {"x": x, "y": y}})

    graph.until(lambda: move_base.goals)
    x, y = move_base.goals[0]
    assert x == pytest.approx(1.025)
    assert 0.2 < y < 0.8
    known = grid(None)
    maps.publish(known)
    graph.until(lambda: results)
    assert results[0].status.status == 3
    assert all(0.2 < y < 0.8 for _, y in move_base.goals)


def test_a_server_without_its_layer_ends_with_a_sentence(graph: Any) -> None:
    log = graph.listen("/rosout", "rosgraph_msgs/Log")
    costmap = {"plugins": [{"name": "inflation", "type": "costmap_2d::InflationLayer"}]}
    assert graph.start("frontier_exploration/explore_server", explore_costmap=costmap).result(60.0) == 1
    graph.until(lambda: any("no plugin frontier_exploration::BoundedExploreLayer" in str(line.msg) for line in log))
