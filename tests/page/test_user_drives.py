"""A person drives with a gamepad, within limits, and loses the connection; the robot hears it or stands."""

import os
import signal
from collections.abc import Iterator
from itertools import pairwise
from typing import Any
from urllib.parse import urlsplit

import pytest
from tests.graphs import Graph, running_graph
from tests.page.built_client import needs_client
from tests.page.driving.test_driving import Robot
from tests.page.panel_user import PanelUser

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, Session
from trundle.ros import Node

pytestmark = needs_client

FAKE_PAD = """window.pad = {
  index: 0, id: "Pad", connected: true, mapping: "standard", axes: [0, 0, 0, 0], buttons: []
};
navigator.getGamepads = () => [window.pad, null];
const tell = (kind) => dispatchEvent(Object.assign(new Event(kind), { gamepad: window.pad }));"""
STANDS = (0.0, 0.0)


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


@pytest.fixture(scope="module")
def node(graph: Graph) -> Node:
    node = graph.node("robot_base")
    graph.ready(node)
    return node


@pytest.fixture(scope="module")
def robot(graph: Graph, node: Node) -> Robot:
    robot = Robot(node, "/base/cmd_vel")
    graph.ready(node)
    return robot


def _serve(graph: Graph, node: Node, port: int = 0) -> PageServer:
    session = Session(title="t", kind="graph", drive_topic="/base/cmd_vel")
    return PageServer.start(
        session, at=PageAddress(port=port), graph=GraphAddress(master_uri=graph.core.uri), node=node
    )


@pytest.fixture(scope="module")
def server(graph: Graph, node: Node, robot: Robot) -> Iterator[PageServer]:
    with _serve(graph, node) as server:
        yield server


@pytest.fixture(scope="module")
def user(chromium: Any, server: PageServer) -> Iterator[PanelUser]:
    user = PanelUser(chromium, server.url)
    user.page.locator(".disc").wait_for()
    yield user
    user.close()


def _push(user: PanelUser, x: float, y: float) -> None:
    """Push the left stick, and wait until the page has read it."""
    user.page.evaluate(f"window.pad.axes = [{x}, {y}, 0, 0]")
    user.page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")


@pytest.mark.slow
def test_a_gamepad_drives_within_the_limits_and_stops(graph: Graph, robot: Robot, user: PanelUser) -> None:
    """A stick that was never at rest does not drive; one let go, or unplugged, stops."""
    user.page.get_by_role("textbox", name="Greatest speed").fill("0.8")
    user.page.keyboard.press("Enter")
    user.page.locator(".disc").focus()
    user.page.evaluate(
        FAKE_PAD.replace("[0, 0, 0, 0]", "[0, -1, 0, 0]") + 'tell("gamepadconnected"); window.tell = tell'
    )
    user.page.wait_for_timeout(500)
    assert robot.velocities == []

    _push(user, 0, 0)
    _push(user, 0.5, -1)
    graph.until(lambda: robot.velocities.count((0.8, -0.5)) >= 3)
    _push(user, 0, 0)
    graph.until(lambda: robot.velocities[-1] == STANDS)
    _push(user, 0, -1)
    graph.until(lambda: robot.velocities[-1] == (0.8, 0.0))
    user.page.evaluate('window.tell("gamepaddisconnected"); window.pad = null')
    graph.until(lambda: robot.velocities[-1] == STANDS)
    user.until_still(lambda: len(robot.heard))

    assert (STANDS, STANDS) not in pairwise(robot.velocities)  # one stop goes out at a time


def test_a_lost_connection_is_said_stops_the_robot_and_comes_back(
    graph: Graph, node: Node, robot: Robot, server: PageServer, user: PanelUser
) -> None:
    """Last: it ends the server, and the next one has its address."""
    user.page.locator(".disc").focus()
    user.page.keyboard.down("w")
    graph.until(lambda: robot.velocities and robot.velocities[-1][0] > 0)
    os.kill(server.process_id, signal.SIGKILL)
    graph.until(lambda: robot.velocities[-1] == STANDS)
    status = user.page.get_by_role("banner").get_by_role("status")
    status.get_by_text("Connection lost, trying again").first.wait_for()
    user.page.locator("main.lost").wait_for()
    user.page.keyboard.up("w")
    user.page.keyboard.press("w")  # drives nothing
    before = len(robot.heard)
    with _serve(graph, node, port=urlsplit(server.url).port or 0) as again:
        user.page.context.request.get(again.url)  # as the tab that the next run opens; its cookie lets this one in
        status.get_by_text("Connected").first.wait_for()
        user.page.locator("main.lost").wait_for(state="detached")
        assert len(robot.heard) == before
        user.page.keyboard.down("s")
        graph.until(lambda: robot.velocities[-1][0] < 0)
        user.page.keyboard.up("s")
        graph.until(lambda: robot.velocities[-1] == STANDS)
