"""A user uses the tools and the interactive markers in the 3D view; messages on the graph are checked."""

import math
from collections.abc import Iterator
from typing import Any

import pytest
from tests.graphs import Graph, running_graph
from tests.page.built_client import needs_client
from tests.page.scene_user import PX_PER_M, VIEW_CANVAS, SceneUser, rviz_text

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, RvizFile, Session
from trundle.ros import Node

pytestmark = needs_client

RVIZ = rviz_text(
    {"Class": "rviz/InteractiveMarkers", "Name": "Handles", "Enabled": True, "Update Topic": "/handles/update"},
    {"Class": "rviz/LaserScan", "Name": "Scan", "Enabled": True, "Topic": "/scan", "Size (m)": 0.1},
)
HEADER = {"frame_id": "map"}
NOTHING = {"x": 0.0, "y": 0.0, "z": 0.0}
ALONG_X = {**NOTHING, "w": 1.0}
ALONG_Z = {"x": 0.0, "y": math.sqrt(0.5), "z": 0.0, "w": math.sqrt(0.5)}
"""Orientations of a control whose x axis points along the world's x or −z."""
MENU, BUTTON, MOVE_AXIS, MOVE_PLANE, ROTATE_AXIS = 1, 2, 3, 4, 5
POSE, MENU_SELECT, CLICK, DOWN, UP = 1, 2, 3, 4, 5
GRIP = 0.575
"""Radius of a ring's middle, and distance of an arrow from its marker [m]."""


def _marker(name: str, position: tuple[float, float], control: dict[str, Any], **fields: Any) -> dict[str, Any]:
    x, y = position
    pose = {"position": {"x": x, "y": y, "z": 0.0}, "orientation": ALONG_X}
    return {
        "header": HEADER,
        "name": name,
        "pose": pose,
        "scale": 1.0,
        "controls": [{"name": name, **control}],
        **fields,
    }


CUBE = {
    "type": 1,
    "pose": {"position": NOTHING, "orientation": ALONG_X},
    "scale": {"x": 0.6, "y": 0.6, "z": 0.6},
    "color": {"r": 0.2, "g": 0.4, "b": 0.9, "a": 1.0},
}
ENTRIES = [
    {"id": 1, "parent_id": 0, "title": "Go home"},
    {"id": 2, "parent_id": 0, "title": "Speed"},
    {"id": 7, "parent_id": 2, "title": "Slow"},
]
MARKERS = [
    _marker("slider", (-2.0, 1.0), {"interaction_mode": MOVE_AXIS, "orientation": ALONG_X}),
    _marker("plate", (0.0, 1.0), {"interaction_mode": MOVE_PLANE, "orientation": ALONG_Z}),
    _marker("dial", (2.0, 1.0), {"interaction_mode": ROTATE_AXIS, "orientation": ALONG_Z}),
    _marker("knob", (-2.0, -1.0), {"interaction_mode": BUTTON, "markers": [CUBE]}, menu_entries=ENTRIES),
]
LISTENED = {
    "/clicked_point": "geometry_msgs/PointStamped",
    "/handles/feedback": "visualization_msgs/InteractiveMarkerFeedback",
    "/initialpose": "geometry_msgs/PoseWithCovarianceStamped",
    "/robot/goal": "geometry_msgs/PoseStamped",
}
SCAN = {
    "header": HEADER,
    "angle_min": 0.0,
    "angle_increment": math.pi / 2,
    "range_min": 0.1,
    "range_max": 9.0,
    "ranges": [0.5, 1.0],
    "intensities": [10.0, 20.0],
}
"""Scan of two points, at (0.5, 0) and (0, 1)."""


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


@pytest.fixture(scope="module")
def node(graph: Graph) -> Node:
    node = graph.node("tester")
    init = node.advertise("/handles/update_full", "visualization_msgs/InteractiveMarkerInit", latch=True)
    init.publish({"server_id": "/tester", "seq_num": 1, "markers": MARKERS})
    node.advertise("/handles/update", "visualization_msgs/InteractiveMarkerUpdate")
    node.advertise("/scan", "sensor_msgs/LaserScan", latch=True).publish(SCAN)
    return node


@pytest.fixture(scope="module")
def received(node: Node) -> dict[str, list[Any]]:
    """Received messages by topic, from subscriptions made before the page starts."""
    messages: dict[str, list[Any]] = {}
    for topic, kind in LISTENED.items():
        messages[topic] = []
        node.subscribe(topic, kind, messages[topic].append)
    return messages


@pytest.fixture(scope="module")
def server(graph: Graph, node: Node, received: dict[str, list[Any]]) -> Iterator[PageServer]:
    session = Session(title="t", kind="graph", rviz=RvizFile(name="t.rviz", text=RVIZ, writable=True))
    address = GraphAddress(master_uri=graph.core.uri)
    graph.ready(node)
    with PageServer.start(session, at=PageAddress(port=0), graph=address, node=node) as server:
        yield server


@pytest.fixture(scope="module")
def user(chromium: Any, server: PageServer) -> Iterator[SceneUser]:
    user = SceneUser(chromium, server.url)
    points = ((-2.0, -1.0), (2.0 - GRIP, 1.0), (0.5, 0.0))  # a button, a ring, a point of the scan
    user.until(lambda: all(user.sees_at(point) for point in points), what="for the markers and the scan")
    yield user
    user.close()


@pytest.fixture(scope="module")
def feedback(received: dict[str, list[Any]]) -> list[Any]:
    return received["/handles/feedback"]


def _position(message: Any) -> tuple[float, float]:
    return (message.pose.position.x, message.pose.position.y)


def _dragged(graph: Graph, feedback: list[Any], name: str) -> Any:
    """Wait for the end of a drag and check its feedback; return the last message."""
    graph.until(lambda: feedback and feedback[-1].event_type == UP)
    events = [message.event_type for message in feedback]
    assert (events[0], events[-1]) == (DOWN, UP)
    assert {(message.marker_name, message.header.frame_id) for message in feedback} == {(name, "map")}
    last = [message for message in feedback if message.event_type == POSE][-1]
    feedback.clear()
    return last


@pytest.mark.slow
def test_a_clicked_point_is_published(graph: Graph, user: SceneUser, received: dict[str, list[Any]]) -> None:
    """The scale is in the .rviz file."""
    points = received["/clicked_point"]
    user.tool("Publish Point")
    user.click((2.0, -1.0))
    graph.until(lambda: points)

    assert (points[0].point.x, points[0].point.y) == pytest.approx((2.0, -1.0), abs=1.1 / PX_PER_M)
    assert points[0].header.frame_id == "map"


@pytest.mark.slow
def test_a_marker_slides_along_its_axis(graph: Graph, user: SceneUser, feedback: list[Any]) -> None:
    user.drag((-2.0 + 0.7, 1.0), (-2.0 + 1.2, 1.3))

    assert _position(_dragged(graph, feedback, "slider")) == pytest.approx((-1.5, 1.0), abs=0.03)


@pytest.mark.slow
def test_a_marker_moves_in_its_plane(graph: Graph, user: SceneUser, feedback: list[Any]) -> None:
    user.drag((GRIP, 1.0), (GRIP + 0.25, 1.8))

    assert _position(_dragged(graph, feedback, "plate")) == pytest.approx((0.25, 1.8), abs=0.03)


@pytest.mark.slow
def test_a_marker_turns_about_its_axis(graph: Graph, user: SceneUser, feedback: list[Any]) -> None:
    user.drag((2.0 + GRIP, 1.0), (2.4, 1.4), (2.0, 1.0 + GRIP))

    turned = _dragged(graph, feedback, "dial").pose
    assert 2 * math.atan2(turned.orientation.z, turned.orientation.w) == pytest.approx(math.pi / 2, abs=0.06)
    assert (turned.position.x, turned.position.y) == (2.0, 1.0)


@pytest.mark.slow
def test_a_marker_is_clicked_and_a_menu_entry_chosen(graph: Graph, user: SceneUser, feedback: list[Any]) -> None:
    user.click((-2.0, -1.0))
    graph.until(lambda: CLICK in [message.event_type for message in feedback])
    feedback.clear()
    user.click((-2.0, -1.0), button="right")
    menu = user.page.get_by_role("menu")
    assert menu.get_by_role("menuitem", name="Speed").is_disabled()
    menu.get_by_role("menuitem", name="Slow").click()
    graph.until(lambda: MENU_SELECT in [message.event_type for message in feedback])

    assert [message.menu_entry_id for message in feedback if message.event_type == MENU_SELECT] == [7]
    user.click((-2.0, -1.0), button="right")
    user.page.keyboard.press("Enter")  # the first entry has the focus
    graph.until(lambda: [m.menu_entry_id for m in feedback if m.event_type == MENU_SELECT] == [7, 1])


@pytest.mark.slow
def test_a_pose_estimate_has_its_configured_deviations(
    graph: Graph, user: SceneUser, received: dict[str, list[Any]]
) -> None:
    poses = received["/initialpose"]
    user.side("Tool properties")
    user.set("X std deviation [m]", "2")
    user.tool("2D Pose Estimate")
    user.drag((1.0, -1.0), (1.0, -0.4))
    graph.until(lambda: poses)

    pose = poses[0].pose
    assert (pose.pose.position.x, pose.pose.position.y) == pytest.approx((1.0, -1.0), abs=0.02)
    assert 2 * math.atan2(pose.pose.orientation.z, pose.pose.orientation.w) == pytest.approx(math.pi / 2, abs=0.02)
    assert [pose.covariance[i] for i in (0, 7, 35)] == pytest.approx([4.0, 0.25, (math.pi / 12) ** 2])


def test_a_goal_is_published_on_its_configured_topic(
    graph: Graph, user: SceneUser, received: dict[str, list[Any]]
) -> None:
    goals = received["/robot/goal"]
    user.side("Tool properties")
    user.page.get_by_role("treeitem", name="2D Nav Goal").locator("xpath=following-sibling::*[1]").locator(
        "input"
    ).fill("/robot/goal")
    user.page.keyboard.press("Enter")
    user.page.locator(VIEW_CANVAS).focus()
    user.page.keyboard.press("g")
    user.drag((-1.0, -1.0), (-1.5, -1.0))
    graph.until(lambda: goals)

    assert (goals[0].pose.position.x, goals[0].pose.position.y) == pytest.approx((-1.0, -1.0), abs=0.02)
    assert abs(goals[0].pose.orientation.z) == pytest.approx(1.0, abs=0.01)


@pytest.mark.slow
def test_selecting_a_point_shows_its_values_and_a_box_selects_several(user: SceneUser) -> None:
    user.tool("Select")
    user.click((0.5, 0.0))
    fields = user.page.get_by_role("tree", name="Fields")
    user.side("Inspector")
    fields.get_by_role("treeitem").filter(has_text="intensity").filter(has_text="10").first.wait_for()
    user.page.get_by_role("heading", name="Scan").wait_for()
    user.drag((-0.4, -0.3), (0.8, 1.3))
    user.page.get_by_role("heading", name="2 selected").wait_for()
    user.page.locator(VIEW_CANVAS).focus()
    user.page.keyboard.press("Escape")
    user.page.get_by_text("Nothing is selected.").wait_for()


@pytest.mark.slow
def test_a_distance_is_measured(user: SceneUser) -> None:
    user.tool("Measure")
    user.click((1.0, -0.5))
    user.click((1.0, -1.25))

    user.page.get_by_role("status").get_by_text("0.750 m").wait_for()
    user.click((1.0, -0.5), button="right")
    user.page.get_by_role("status").get_by_text("Click two points.").wait_for()
    user.tool("Interact")


@pytest.mark.slow
def test_the_camera_is_moved_although_a_marker_is_under_the_pointer(user: SceneUser, feedback: list[Any]) -> None:
    """The drag starts at the plate, which it would move with Interact."""
    user.side("Views")
    feedback.clear()
    user.tool("Move camera")
    angle = user.property("Angle [rad]")
    user.drag((0.0, 1.0), (0.4, 1.0))
    user.until(lambda: angle.input_value() != "0")
    assert feedback == []
    user.set("Angle [rad]", "0")
    user.tool("Interact")


@pytest.mark.slow
def test_a_point_is_focused_and_the_view_saved(user: SceneUser, server: PageServer) -> None:
    """Must be last, as it moves the ground."""
    user.side("Views")
    user.page.get_by_role("button", name="Save current view").click()
    user.tool("Focus")
    user.click((1.0, -1.0))
    user.until(lambda: user.property("X [m]").input_value() == "1")
    user.page.get_by_role("button", name="Use TopDownOrtho 1").click()
    user.until(lambda: user.property("X [m]").input_value() == "0")
    user.page.get_by_label("Type of view").select_option("Orbit")
    user.property("Distance [m]").wait_for()
    user.side("Displays")
    user.page.get_by_role("button", name="Save", exact=True).click()
    requests: list[Any] = []
    user.until(lambda: requests.extend(server.requests()) or requests)
    server.respond(requests[0].id)
    import yaml

    views = yaml.safe_load(requests[0].action.text)["Visualization Manager"]["Views"]
    assert views["Current"]["Class"] == "rviz/Orbit"
    assert [(view["Class"], view["Name"]) for view in views["Saved"]] == [("rviz/TopDownOrtho", "TopDownOrtho 1")]
