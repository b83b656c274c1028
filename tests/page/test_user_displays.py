"""A user adds, edits and removes displays; picture and subscriptions follow."""

import math
from collections.abc import Iterator, Mapping
from typing import Any

import pytest
from tests.graphs import Graph, running_graph
from tests.page.built_client import needs_client
from tests.page.scene_user import SceneUser, rviz_text
from tests.page.sensor_messages import COLORS, MAP, TWIST, cloud, covariance, depth, point, pose, ring

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, RvizFile, Session
from trundle.ros import Node, Publisher

pytestmark = needs_client

HEADER = {"frame_id": "map"}
GREEN, RED, WHITE = (0, 255, 0), (255, 0, 0), (255, 255, 255)
SCAN = {
    "header": HEADER,
    "angle_min": 0.0,
    "angle_increment": math.pi / 2,
    "range_min": 0.1,
    "range_max": 9.0,
    "ranges": [1.0, 1.0, 1.0, 1.0],
}
"""Scan of four points, 1 m from the origin."""
FAR_SCAN = SCAN | {"ranges": [2.0, 9.5, 2.0, 9.5]}
"""Scan of two points, 2 m from the origin."""

SHOWN: Mapping[str, tuple[str, Mapping[str, Any]]] = {
    "/accel": ("geometry_msgs/AccelStamped", {"header": HEADER, "accel": TWIST}),
    "/cells": (
        "nav_msgs/GridCells",
        {"header": HEADER, "cell_width": 0.5, "cell_height": 0.3, "cells": [at["position"] for at in ring(6, 1.0)]},
    ),
    "/cloud": ("sensor_msgs/PointCloud", {"header": HEADER, "points": [point(0, 0), point(1, 1)]}),
    "/cube": (
        "visualization_msgs/Marker",
        {"header": HEADER, "type": 1, "pose": pose(0, 0), "scale": point(1, 1, 1), "color": {"r": 1.0, "a": 1.0}},
    ),
    "/cubes": (
        "visualization_msgs/MarkerArray",
        {
            "markers": [
                {
                    "header": HEADER,
                    "type": 2,
                    "pose": pose(0, 0),
                    "scale": point(1, 1, 1),
                    "color": {"g": 1.0, "a": 1.0},
                }
            ]
        },
    ),
    "/goal": ("geometry_msgs/PoseStamped", {"header": HEADER, "pose": pose(0, 0)}),
    "/here": ("geometry_msgs/PointStamped", {"header": HEADER, "point": point(0, 0)}),
    "/humidity": ("sensor_msgs/RelativeHumidity", {"header": HEADER, "relative_humidity": 0.5}),
    "/imu": ("sensor_msgs/Imu", {"header": HEADER, "orientation": {"w": 1.0}, "linear_acceleration": point(1, 0)}),
    "/light": ("sensor_msgs/Illuminance", {"header": HEADER, "illuminance": 300.0}),
    "/map": ("nav_msgs/OccupancyGrid", MAP),
    "/odom": ("nav_msgs/Odometry", {"header": HEADER, "pose": {"pose": pose(0, 0), "covariance": covariance(0.1)}}),
    "/outline": (
        "geometry_msgs/PolygonStamped",
        {"header": HEADER, "polygon": {"points": [point(1, 1), point(-1, 1), point(-1, -1)]}},
    ),
    "/path": (
        "nav_msgs/Path",
        {"header": HEADER, "poses": [{"header": HEADER, "pose": at} for at in ring(9, 1.0)]},
    ),
    "/points": ("sensor_msgs/PointCloud2", cloud([(x / 3, y / 3, z, c) for x, y, z, c in COLORS], "rgb")),
    "/poses": ("geometry_msgs/PoseArray", {"header": HEADER, "poses": ring(6, 1.0)}),
    "/pressure": ("sensor_msgs/FluidPressure", {"header": HEADER, "fluid_pressure": 101000.0}),
    "/sonar": ("sensor_msgs/Range", {"header": HEADER, "field_of_view": 0.6, "max_range": 4.0, "range": 1.0}),
    "/sure": (
        "geometry_msgs/PoseWithCovarianceStamped",
        {"header": HEADER, "pose": {"pose": pose(0, 0), "covariance": covariance(0.1)}},
    ),
    "/temperature": ("sensor_msgs/Temperature", {"header": HEADER, "temperature": 70.0}),
    "/twist": ("geometry_msgs/TwistStamped", {"header": HEADER, "twist": TWIST}),
    "/wrench": (
        "geometry_msgs/WrenchStamped",
        {"header": HEADER, "wrench": {"force": TWIST["linear"], "torque": TWIST["angular"]}},
    ),
}
"""Topic → type and message that are drawn at the origin."""
OF_POINTS = ("PointCloud", "PointCloud2", "FluidPressure", "Illuminance", "RelativeHumidity", "Temperature")
"""Displays of points, whose default size is a pixel."""


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


@pytest.fixture(scope="module")
def node(graph: Graph) -> Node:
    return graph.node("tester")


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
    yield user
    user.close()


def _latched(node: Node, topic: str, kind: str, message: Mapping[str, Any]) -> Publisher:
    publisher = node.advertise(topic, kind, latch=True)
    publisher.publish(message)
    return publisher


def test_a_scan_is_shown_by_a_click_and_its_properties_are_edited(graph: Graph, node: Node, user: SceneUser) -> None:
    """Topic, transformer, color, size, style and visibility; every edit can be undone."""
    near, far = (
        _latched(node, "/scan", "sensor_msgs/LaserScan", SCAN),
        _latched(node, "/far", "sensor_msgs/LaserScan", FAR_SCAN),
    )
    user.button("Show /scan").click()
    graph.until(lambda: near.has_subscribers)
    user.open_rows("LaserScan")
    user.property("Color Transformer").fill("FlatColor")
    user.property("Color Transformer").press("Enter")
    user.set("Color", "0; 255; 0")
    user.set("Size (m)", "0.2")
    user.until_area(GREEN, 4 * 0.2**2)
    user.set("Size (m)", "0.4")
    user.until_area(GREEN, 4 * 0.4**2)
    user.property("Style").select_option("Points")
    user.set("Size (Pixels)", "10")
    user.until_area(GREEN, 4 * 0.1**2, within=0.25)
    user.property("Color, picker").fill("#ff0000")
    user.until_area(RED, 4 * 0.1**2, within=0.25)
    assert user.property("Color").input_value() == "255; 0; 0"

    user.set("Topic", "/far")
    graph.until(lambda: far.has_subscribers and not near.has_subscribers)
    user.until_area(RED, 2 * 0.1**2, within=0.25)
    user.page.get_by_role("treeitem").filter(has_text="Global Options").first.click()  # so that the press selects, too
    user.page.get_by_role("checkbox", name="Show LaserScan").uncheck()
    graph.until(lambda: not far.has_subscribers)
    user.until_area(RED, 0.0)

    user.page.get_by_role("treeitem").filter(has_text="LaserScan").first.focus()
    for _ in range(3):  # the checkbox, the topic, the color
        user.page.keyboard.press("Control+z")
    user.until_area(GREEN, 4 * 0.1**2, within=0.25)
    user.page.keyboard.press("Control+Shift+Z")
    user.until_area(RED, 4 * 0.1**2, within=0.25)
    user.page.keyboard.press("Delete")
    graph.until(lambda: not near.has_subscribers)
    for publisher in (near, far):
        publisher.unregister()


@pytest.mark.slow
def test_a_display_shows_why_it_cannot_show_a_topic(node: Node, user: SceneUser) -> None:
    publisher = _latched(
        node, "/lost", "geometry_msgs/PointStamped", {"header": {"frame_id": "moon"}, "point": point(0, 0)}
    )
    user.button("Show /lost").click()
    user.page.get_by_role("treeitem").filter(has_text="No transform").first.wait_for()
    user.page.get_by_role("status").get_by_text("1 display has no transform").wait_for()
    user.button("Details").click()
    dialog = user.page.get_by_role("dialog")
    dialog.get_by_text("nothing publishes moon", exact=False).wait_for()
    dialog.get_by_role("button", name="Show").click()
    user.button("Remove").click()
    user.page.get_by_text("1 display has no transform").wait_for(state="detached")
    publisher.unregister()


@pytest.mark.slow
def test_every_topic_is_found_shown_and_removed(graph: Graph, node: Node, user: SceneUser) -> None:
    """Every display of rviz, by its message type: it subscribes, draws something, and is removed."""
    for topic, (kind, message) in SHOWN.items():
        publisher = _latched(node, topic, kind, message)
        user.button(f"Show {topic}").click()
        graph.until(lambda publisher=publisher: publisher.has_subscribers)
        name = kind.partition("/")[2]
        if name in OF_POINTS:
            user.open_rows(name)
            user.set("Size (m)", "0.1")
        user.until(lambda: user.is_something_drawn, what=f"for {topic}")
        user.button("Remove").click()
        graph.until(lambda publisher=publisher: not publisher.has_subscribers)
        user.until(lambda: not user.picture().any(), what=f"for the end of {topic}")
        publisher.unregister()


@pytest.mark.slow
def test_displays_without_a_topic_are_added_by_class(graph: Graph, node: Node, user: SceneUser) -> None:
    """Grid, Axes, TF, the robot, and a group that hides its displays."""
    urdf = '<robot name="r"><link name="base"><visual><geometry><box size="1 1 1"/></geometry></visual></link></robot>'
    graph.loop.run(node.params.set("/robot_description", urdf))
    frames = {"header": HEADER, "child_frame_id": "base", "transform": {"rotation": {"w": 1.0}}}
    publisher = _latched(node, "/tf_static", "tf2_msgs/TFMessage", {"transforms": [frames]})
    user.page.get_by_role("tab", name="By class").click()
    for name in ("Grid", "Axes", "TF", "RobotModel"):
        user.button(f"Add rviz/{name}".replace("rviz/", "")).click()
        user.until(lambda: user.is_something_drawn, what=f"for {name}")
        user.page.get_by_role("treeitem").filter(has_text=name).first.focus()
        user.page.keyboard.press(" ")
        user.until(lambda: not user.picture().any(), what=f"for the end of {name}")
        user.button("Remove").click()
    publisher.unregister()


@pytest.mark.slow
def test_pictures_have_a_tile_that_can_be_enlarged(graph: Graph, node: Node, user: SceneUser) -> None:
    """Image, Camera with the scene overlaid, and DepthCloud share the topics of a camera."""
    publishers = [_latched(node, *message) for message in depth()]
    user.page.get_by_role("tab", name="Topics not shown").click()
    user.button("Show /depth/color").click()
    user.page.get_by_role("button", name="Enlarge Image").first.click()
    large = user.page.locator(".tile.large")
    large.get_by_role("img", name="Camera image Image").wait_for()
    assert large.bounding_box()["width"] > 400
    user.page.keyboard.press("Escape")
    large.wait_for(state="detached")
    user.button("Remove").click()
    for publisher in publishers:
        publisher.unregister()
