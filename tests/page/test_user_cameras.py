"""A user adds displays by class and chooses their topics: cameras, depth images, efforts."""

from collections.abc import Iterator, Mapping
from typing import Any

import pytest
from tests.graphs import Graph, running_graph
from tests.page.built_client import needs_client
from tests.page.scene_user import SceneUser, rviz_text
from tests.page.sensor_messages import HEADER, point, pose

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, RvizFile, Session
from trundle.ros import Node, Publisher

pytestmark = [pytest.mark.slow, needs_client]

GREEN, RED, WHITE = (0, 255, 0), (255, 0, 0), (255, 255, 255)
OPTICAL = {"frame_id": "eye", "stamp": {"secs": 1, "nsecs": 0}}
DOWN = {"translation": point(0, 0, 2), "rotation": {"x": 1.0, "y": 0.0, "z": 0.0, "w": 0.0}}
"""Camera 2 m above the origin that looks straight down."""
WIDTH, HEIGHT, FOCAL = 64, 48, 64.0
INFO = {
    "header": OPTICAL,
    "width": WIDTH,
    "height": HEIGHT,
    "K": [FOCAL, 0.0, WIDTH / 2, 0.0, FOCAL, HEIGHT / 2, 0.0, 0.0, 1.0],
    "P": [FOCAL, 0.0, WIDTH / 2, 0.0, 0.0, FOCAL, HEIGHT / 2, 0.0, 0.0, 0.0, 1.0, 0.0],
}
PICTURE = {"header": OPTICAL, "width": WIDTH, "height": HEIGHT, "encoding": "rgb8", "step": 3 * WIDTH}
GREEN_PICTURE = PICTURE | {"data": bytes(GREEN) * WIDTH * HEIGHT}
DEPTHS = PICTURE | {"encoding": "16UC1", "step": 2 * WIDTH, "data": (2000).to_bytes(2, "little") * WIDTH * HEIGHT}
"""Depth of 2 m everywhere: a ground of 2 m x 1.5 m."""
RED_CUBE = {
    "header": HEADER,
    "type": 1,
    "pose": pose(0, 0),
    "scale": point(0.5, 0.5, 0.5),
    "color": {"r": 1.0, "a": 1.0},
}
ARM = """<robot name="r"><link name="base"/><link name="arm"/><joint name="shoulder" type="revolute">
<parent link="base"/><child link="arm"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="20" velocity="1"/>
</joint></robot>"""


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


@pytest.fixture(scope="module")
def node(graph: Graph) -> Node:
    node = graph.node("tester")
    graph.loop.run(node.params.set("/robot_description", ARM))
    frames = {"eye": DOWN, "arm": {"translation": point(0, 0, 0), "rotation": {"w": 1.0}}}
    transforms = [
        {"header": HEADER, "child_frame_id": name, "transform": transform} for name, transform in frames.items()
    ]
    _latched(node, "/tf_static", "tf2_msgs/TFMessage", {"transforms": transforms})
    return node


@pytest.fixture(scope="module")
def server(graph: Graph, node: Node) -> Iterator[PageServer]:
    session = Session(title="t", kind="graph", rviz=RvizFile(name="t.rviz", text=rviz_text(), writable=True))
    address = GraphAddress(master_uri=graph.core.uri)
    with PageServer.start(session, at=PageAddress(port=0), graph=address, node=node) as server:
        yield server


@pytest.fixture(scope="module")
def user(chromium: Any, server: PageServer) -> Iterator[SceneUser]:
    user = SceneUser(chromium, server.url)
    user.open("Log")  # the panel of topics subscribes to all of them
    user.button("Add").click()
    user.page.get_by_role("tab", name="By class").click()
    yield user
    user.close()


def _latched(node: Node, topic: str, kind: str, message: Mapping[str, Any]) -> Publisher:
    publisher = node.advertise(topic, kind, latch=True)
    publisher.publish(message)
    return publisher


def _remove(user: SceneUser, graph: Graph, *publishers: Publisher) -> None:
    """Remove the selected display; wait until its subscription and its picture have ended."""
    user.button("Remove").click()
    graph.until(lambda: not any(publisher.has_subscribers for publisher in publishers))
    user.until(lambda: not user.picture().any(), what="for its end")
    for publisher in publishers:
        publisher.unregister()


def _pixel(user: SceneUser, x: float, y: float, index: int = 0) -> tuple[int, int, int]:
    """Return the color of an enlarged picture at fractions of its width and height."""
    script = """([canvas, x, y]) => {
        const pixels = canvas.getContext("2d").getImageData(x * canvas.width, y * canvas.height, 1, 1).data;
        return [...pixels.slice(0, 3)];
    }"""
    canvas = user.page.locator(".tile.large canvas").nth(index).element_handle()
    return tuple(user.page.evaluate(script, [canvas, x, y]))


def test_a_camera_shows_the_scene_over_its_picture(graph: Graph, node: Node, user: SceneUser) -> None:
    """A half transparent red cube is drawn over a green picture; without the overlay the cube is red."""
    info = _latched(node, "/eye/camera_info", "sensor_msgs/CameraInfo", INFO)
    image = _latched(node, "/eye/image", "sensor_msgs/Image", GREEN_PICTURE)
    cube = _latched(node, "/cube", "visualization_msgs/Marker", RED_CUBE)
    user.page.get_by_role("tab", name="Topics not shown").click()
    user.button("Show /cube").click()
    user.page.get_by_role("tab", name="By class").click()
    user.button("Add Camera").click()
    user.open_rows("Camera")
    user.set("Image Topic", "/eye/image")
    graph.until(lambda: info.has_subscribers and image.has_subscribers)
    user.button("Enlarge Camera").first.click()
    user.page.locator(".tile.large canvas").wait_for()
    user.until(lambda: _pixel(user, 0.1, 0.1) == GREEN, what="for the picture")
    user.until(lambda: 60 < _pixel(user, 0.5, 0.5)[1] < 200, what="for half of a cube")
    user.property("Image Rendering").select_option("background")
    user.until(lambda: _pixel(user, 0.5, 0.5)[1] < 40, what="for a whole cube")
    user.page.keyboard.press("Escape")
    user.open_rows("Camera")
    user.button("Remove").click()
    graph.until(lambda: not info.has_subscribers and not image.has_subscribers)
    user.open_rows("Marker")
    _remove(user, graph, cube, info, image)


def test_two_enlarged_pictures_are_side_by_side(graph: Graph, node: Node, user: SceneUser) -> None:
    """They have their own colors and do not overlap."""
    publishers = {}
    for name, color in (("left", GREEN), ("right", RED)):
        publishers[name] = _latched(
            node, f"/{name}/image", "sensor_msgs/Image", PICTURE | {"data": bytes(color) * WIDTH * HEIGHT}
        )
        user.page.get_by_role("tab", name="Topics not shown").click()
        user.button(f"Show /{name}/image").click()
    tiles = user.page.get_by_role("group", name="Cameras").locator(".tile")
    large = user.page.locator(".tile.large")
    for index in range(2):
        tiles.nth(index).get_by_role("button", name="Enlarge Image").first.click()
    user.until(lambda: large.count() == 2 and all(large.nth(i).locator("canvas").count() for i in range(2)), what="two")
    user.until(lambda: [_pixel(user, 0.5, 0.5, index) for index in range(2)] == [GREEN, RED], what="for their colors")
    left, right = (large.nth(index).bounding_box() for index in range(2))
    assert left["x"] + left["width"] <= right["x"]
    assert left["y"] == pytest.approx(right["y"], abs=1)
    assert min(left["width"], right["width"]) > 250

    user.page.keyboard.press("Escape")
    large.first.wait_for(state="detached")
    for publisher in publishers.values():
        user.open_rows("Image")
        user.button("Remove").click()
        publisher.unregister()
    user.page.get_by_role("tab", name="By class").click()


def test_a_depth_image_is_drawn_as_a_cloud_with_the_colors_of_another_image(
    graph: Graph, node: Node, user: SceneUser
) -> None:
    publishers = (
        _latched(node, "/eye/camera_info", "sensor_msgs/CameraInfo", INFO),
        _latched(node, "/eye/depth", "sensor_msgs/Image", DEPTHS),
        _latched(node, "/eye/color", "sensor_msgs/Image", GREEN_PICTURE),
    )
    user.button("Add DepthCloud").click()
    user.open_rows("DepthCloud")
    user.set("Depth Map Topic", "/eye/depth")
    user.until(lambda: user.is_something_drawn, what="for the cloud")
    user.set("Color Image Topic", "/eye/color")
    graph.until(lambda: publishers[2].has_subscribers)
    publishers[1].publish(DEPTHS)
    user.until_area(GREEN, 2.0 * 1.5, within=0.05)
    _remove(user, graph, *publishers)


def test_an_effort_is_drawn_as_a_ring_of_proportional_radius(graph: Graph, node: Node, user: SceneUser) -> None:
    """15 of 20 N·m, at a scale of 2 m: 0.05 m + (15/20 + 0.05) · 2 m / 2 from the joint."""
    states = {"header": HEADER, "name": ["shoulder"], "position": [0.0], "velocity": [0.0], "effort": [15.0]}
    publisher = _latched(node, "/joint_states", "sensor_msgs/JointState", states)
    user.button("Add Effort").click()
    user.open_rows("Effort")
    user.set("Topic", "/joint_states")
    graph.until(lambda: publisher.has_subscribers)
    user.set("Scale", "2")
    publisher.publish(states)
    user.until(lambda: user.sees_at((0.85, 0.0)), what="for the ring")
    assert not user.sees_at((0.6, 0.0))
    _remove(user, graph, publisher)
