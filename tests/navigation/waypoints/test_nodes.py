"""Waypoints against a move_base that is everywhere at once, or never arrives."""

import asyncio
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from trundle.ros import ActionResult, ActionServer, StaticTransformBroadcaster, Transform


class FakeMoveBase:
    """Ends each goal at once, unless it is asked to keep the robot waiting."""

    def __init__(self, graph: Any) -> None:
        self.goals: list[tuple[float, float, float]] = []
        self.is_slow = False
        self.is_preempted = False
        self._server = ActionServer(graph.client, "move_base", "move_base_msgs/MoveBase", self._execute)

    async def _execute(self, goal: Any, accept: Callable[[], None]) -> ActionResult:
        accept()
        pose = goal.target_pose.pose
        self.goals.append((pose.position.x, pose.position.y, pose.orientation.w))
        try:
            await asyncio.sleep(60.0 if self.is_slow else 0.0)
        except asyncio.CancelledError:
            self.is_preempted = True
            raise
        return ActionResult()

    def places(self) -> list[tuple[float, float]]:
        return [goal[:2] for goal in self.goals]


@pytest.fixture
def move_base(graph: Any) -> FakeMoveBase:
    static = StaticTransformBroadcaster(graph.client)
    static.send_transform(Transform(parent="map", child="base_footprint", translation=(9.0, 9.0, 0.0)))
    return FakeMoveBase(graph)


def _pose(x: float, y: float) -> dict[str, Any]:
    pose = {"position": {"x": x, "y": y}, "orientation": {"w": 1.0}}
    return {"header": {"frame_id": "map"}, "pose": {"pose": pose}}


def test_a_path_is_followed_once_it_is_ready(graph: Any, move_base: FakeMoveBase) -> None:
    queues = graph.listen("/waypoints", "geometry_msgs/PoseArray")
    graph.start("follow_waypoints/follow_waypoints")
    poses = graph.advertise("/initialpose", "geometry_msgs/PoseWithCovarianceStamped")
    ready = graph.advertise("/path_ready", "std_msgs/Empty")
    for number in range(3):
        poses.publish(_pose(1.0 * number, 2.0))
        graph.until(lambda number=number: queues and len(queues[-1].poses) == number + 1)
    assert not move_base.goals

    ready.publish({})

    graph.until(lambda: len(move_base.goals) == 3)
    assert move_base.places() == [(0.0, 2.0), (1.0, 2.0), (2.0, 2.0)]
    graph.until(lambda: not queues[-1].poses)


def test_a_reset_stops_the_robot_and_empties_the_queue(graph: Any, move_base: FakeMoveBase) -> None:
    move_base.is_slow = True
    queues = graph.listen("/waypoints", "geometry_msgs/PoseArray")
    graph.start("follow_waypoints/follow_waypoints")
    poses = graph.advertise("/initialpose", "geometry_msgs/PoseWithCovarianceStamped")
    ready, reset = (graph.advertise(f"/path_{word}", "std_msgs/Empty") for word in ("ready", "reset"))
    broken = _pose(float("nan"), 0.0)
    for pose in (broken, _pose(1.0, 2.0), _pose(3.0, 4.0)):
        poses.publish(pose)
    graph.until(lambda: queues and len(queues[-1].poses) == 2)
    ready.publish({})
    graph.until(lambda: move_base.goals)

    reset.publish({})

    graph.until(lambda: move_base.is_preempted and not queues[-1].poses)
    assert move_base.places() == [(1.0, 2.0)]


def test_clicked_points_lead_to_the_final_goal(graph: Any, move_base: FakeMoveBase) -> None:
    graph.start("yocs_waypoints_navi/yocs_waypoints_navi_node", frequency=50.0)
    points = graph.advertise("/waypoints", "geometry_msgs/PointStamped")
    goals = graph.advertise("/final_goal", "geometry_msgs/PoseStamped")
    markers = graph.listen("/waypoint_marker", "visualization_msgs/MarkerArray")
    for x in (1.0, 2.0):
        points.publish({"header": {"frame_id": "map"}, "point": {"x": x}})
    graph.until(lambda: markers and len(markers[-1].markers) == 4)

    goals.publish({"header": {"frame_id": "map"}, "pose": {"position": {"x": 5.0}, "orientation": {"w": 1.0}}})

    graph.until(lambda: len(move_base.goals) == 3)
    assert move_base.places() == [(1.0, 0.0), (2.0, 0.0), (5.0, 0.0)]


def test_a_point_near_the_first_one_closes_a_loop(graph: Any, move_base: FakeMoveBase) -> None:
    graph.start("yocs_waypoints_navi/yocs_waypoints_navi_node", frequency=50.0)
    points = graph.advertise("/waypoints", "geometry_msgs/PointStamped")
    for x in (1.0, 2.0, 1.1):
        points.publish({"header": {"frame_id": "map"}, "point": {"x": x}})

    graph.until(lambda: len(move_base.goals) >= 4)
    assert [x for x, _ in move_base.places()[:4]] == [1.0, 2.0, 1.0, 2.0]
    assert [w for _, _, w in move_base.goals[:2]] == pytest.approx([1.0, 0.0], abs=1e-9)  # it faces the next one


def test_the_next_point_is_sent_when_the_robot_is_near(graph: Any, move_base: FakeMoveBase) -> None:
    move_base.is_slow = True
    graph.start("yocs_waypoints_navi/yocs_waypoints_navi_node", frequency=50.0)
    points = graph.advertise("/waypoints", "geometry_msgs/PointStamped")
    for x, y in ((9.1, 9.0), (1.0, 1.0), (9.1, 9.1)):  # the robot stands at 9, 9
        points.publish({"header": {"frame_id": "map"}, "point": {"x": x, "y": y}})

    graph.until(lambda: len(move_base.goals) == 2)
    assert move_base.places() == [(9.1, 9.0), (1.0, 1.0)]


_FILE = """
waypoints:
  - {name: door, frame_id: map, pose: {position: {x: 1, y: 0, z: 0}, orientation: {x: 0, y: 0, z: 0, w: 1}}}
  - {name: desk, frame_id: map, pose: {position: {x: 2, y: 3, z: 0}, orientation: {x: 0, y: 0, z: 1, w: 0}}}
trajectories:
  - {name: to_desk, waypoints: [door, desk]}
"""


def test_waypoints_of_a_file_are_published_and_served(graph: Any, tmp_path: Path) -> None:
    file = tmp_path / "waypoints.yaml"
    file.write_text(_FILE)
    trajectories = graph.listen("/trajectories", "yocs_msgs/TrajectoryList")
    markers = graph.listen("/waypoint_markers", "visualization_msgs/MarkerArray")
    graph.start("yocs_waypoint_provider/waypoint_provider", filename=str(file))

    answer = graph.call("/request_waypoints", "yocs_msgs/WaypointListService")

    assert answer.success
    assert [(w.name, w.pose.position.x) for w in answer.waypoints.waypoints] == [("door", 1.0), ("desk", 2.0)]
    graph.until(lambda: trajectories and markers)
    assert [w.name for w in trajectories[0].trajectories[0].waypoints] == ["door", "desk"]
    assert len(markers[0].markers) == 4


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("[1, 2]", "has no 'waypoints'"),
        ("waypoints: [{name: a}]", "waypoint 'a' has no pose"),
        ("waypoints: []\ntrajectories: [{name: t, waypoints: [b]}]", "no waypoint 'b'; there are: none"),
        ("waypoints: {", "waypoints.yaml"),
    ],
)
def test_a_damaged_file_ends_the_node_in_a_sentence(
    graph: Any, tmp_path: Path, text: str, error: str, capfd: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "waypoints.yaml"
    file.write_text(text)

    assert graph.start("yocs_waypoint_provider/waypoint_provider", filename=str(file)).result(30.0) == 1
    assert error in capfd.readouterr().err
