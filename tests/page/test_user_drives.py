"""A user drives with a gamepad within limits, and loses the connection; the robot follows or stops."""

import os
import signal
import time
from collections.abc import Callable, Iterator
from itertools import pairwise
from typing import Any

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
STOPPED = (0.0, 0.0)
BLOCK = """window.busy = setInterval(() => {
  const end = performance.now() + 500;
  while (performance.now() < end);
}, 1000)"""
"""Blocks the page's thread for half of each second."""


NOTE_RENEWALS = """window.renewals = [];
const post = Worker.prototype.postMessage;
Worker.prototype.postMessage = function (...words) {
  if (words[0]?.kind === "drive") window.renewals.push(performance.now());
  return post.apply(this, words);
};"""
"""Notes the times at which the page renews its lease [ms]."""
LEASE_S = 1.0
_NAP_S = 0.02


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


@pytest.fixture(scope="module")
def server(graph: Graph, node: Node, robot: Robot) -> Iterator[PageServer]:
    session = Session(title="t", kind="graph", drive_topic="/base/cmd_vel")
    address = GraphAddress(master_uri=graph.core.uri)
    with PageServer.start(session, at=PageAddress(port=0), graph=address, node=node) as server:
        yield server


@pytest.fixture(scope="module")
def user(chromium: Any, server: PageServer) -> Iterator[PanelUser]:
    user = PanelUser(chromium, server.url)
    user.page.locator(".disc").wait_for()
    yield user
    user.close()


def _push(user: PanelUser, x: float, y: float) -> None:
    """Move the left stick, and wait until the page has read it."""
    user.page.evaluate(f"window.pad.axes = [{x}, {y}, 0, 0]")
    user.page.wait_for_timeout(150)


@pytest.mark.slow
def test_a_gamepad_drives_within_the_limits_and_stops(graph: Graph, robot: Robot, user: PanelUser) -> None:
    """A stick that was never at rest does not drive; releasing or unplugging it stops."""
    user.page.get_by_role("textbox", name="Largest speed").fill("0.8")
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
    graph.until(lambda: robot.velocities[-1] == STOPPED)
    _push(user, 0, -1)
    graph.until(lambda: robot.velocities[-1] == (0.8, 0.0))
    user.page.evaluate('window.tell("gamepaddisconnected"); window.pad = null')
    graph.until(lambda: robot.velocities[-1] == STOPPED)
    user.until_still(lambda: len(robot.received))

    assert (STOPPED, STOPPED) not in pairwise(robot.velocities)  # stops are sent only once


def _hold(user: PanelUser, control: str) -> Callable[[], object]:
    """Hold a control; return what lets it go."""
    if control == "pad":
        user.page.evaluate(FAKE_PAD + 'tell("gamepadconnected")')
        _push(user, 0, 0)
        _push(user, 0, -1)
        return lambda: user.page.evaluate("window.pad.axes = [0, 0, 0, 0]")
    if control == "disc":
        box = user.page.locator(".disc").bounding_box()
        user.page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        user.page.mouse.down()
        user.page.mouse.move(box["x"] + box["width"] / 2, box["y"])
        return user.page.mouse.up
    user.page.keyboard.down("w")
    return lambda: user.page.keyboard.up("w")


def _longest_stall(duration_s: float) -> float:
    """Sleep in short naps; return by how much the longest was late, as others had the processor [s]."""
    end, late_s = time.monotonic() + duration_s, 0.0
    while (before := time.monotonic()) < end:
        time.sleep(_NAP_S)
        late_s = max(late_s, time.monotonic() - before - _NAP_S)
    return late_s


@pytest.mark.parametrize(
    ("control", "held_s"), [("key", 3), *(pytest.param(c, 20, marks=pytest.mark.slow) for c in ("key", "disc", "pad"))]
)
def test_a_busy_page_drives_without_a_stop(
    graph: Graph, robot: Robot, user: PanelUser, control: str, held_s: int
) -> None:
    user.page.locator(".disc").focus()
    user.page.evaluate(NOTE_RENEWALS + BLOCK)
    robot.received.clear()
    release = _hold(user, control)
    graph.until(lambda: robot.velocities and robot.velocities[-1] != STOPPED)
    robot.received.clear()  # a press on the disc is a velocity of zero, before it is dragged
    graph.until(lambda: robot.received)
    stall_s = _longest_stall(held_s)  # the page's own clock is as busy as the page
    held, stamps_s = robot.velocities, [stamp_s for stamp_s, *_ in robot.received]
    renewals_s = [stamp / 1000 for stamp in user.page.evaluate("clearInterval(window.busy), window.renewals")]
    released_s = time.monotonic()
    release()
    graph.until(lambda: robot.velocities[-1] == STOPPED)
    pause_s, silence_s = (max(b - a for a, b in pairwise(times)) for times in (renewals_s, stamps_s))
    print(f"{len(held) / held_s:.1f} Hz while held; zero {robot.received[-1][0] - released_s:.3f} s after the release")
    print(
        f"the page was silent for up to {pause_s:.2f} s, the server for up to {silence_s:.2f} s, we for {stall_s:.2f} s"
    )

    # A renewal is late by the page's pause and by what its worker and the server wait for the processor.
    is_starved = max(pause_s + stall_s, silence_s) >= 0.9 * LEASE_S  # then a stop is right: others have the processor
    assert is_starved or STOPPED not in held
    assert len(held) > held_s  # far above what a stop and a new start would need
    assert is_starved or robot.velocities.count(STOPPED) == 1
    assert robot.velocities[-1] == STOPPED


def test_a_page_that_hangs_stops_the_robot_until_it_goes_on(graph: Graph, robot: Robot, user: PanelUser) -> None:
    user.page.locator(".disc").focus()
    robot.received.clear()
    user.page.keyboard.down("w")
    graph.until(lambda: robot.received)
    user.page.evaluate("const end = performance.now() + 3000; setTimeout(() => { while (performance.now() < end); })")
    graph.until(lambda: robot.velocities[-1] == STOPPED)
    graph.until(lambda: robot.velocities[-1] != STOPPED)
    user.page.keyboard.up("w")
    graph.until(lambda: robot.velocities[-1] == STOPPED)


def test_late_commands_are_shown(graph: Graph, robot: Robot, server: PageServer, user: PanelUser) -> None:
    user.page.locator(".disc").focus()
    user.page.keyboard.down("w")
    graph.until(lambda: robot.velocities and robot.velocities[-1] != STOPPED)
    os.kill(server.process_id, signal.SIGSTOP)
    try:
        late = user.page.locator(".disc:has(.ring.late)")
        late.get_by_text(" s late").wait_for()
        user.page.locator(".driven").get_by_text("Commands ").wait_for()
    finally:
        os.kill(server.process_id, signal.SIGCONT)
    user.page.locator(".driven").get_by_text("Let go to stop").wait_for()
    late.wait_for(state="detached")
    user.page.keyboard.up("w")
    graph.until(lambda: robot.velocities[-1] == STOPPED)


def test_the_robot_stops_when_the_pages_server_is_killed_and_drives_once_it_is_back(
    graph: Graph, robot: Robot, server: PageServer, user: PanelUser
) -> None:
    user.page.locator(".disc").focus()
    user.page.keyboard.down("w")
    graph.until(lambda: robot.velocities and robot.velocities[-1][0] > 0)
    killed_s = time.monotonic()
    os.kill(server.process_id, signal.SIGKILL)
    graph.until(lambda: robot.velocities[-1] == STOPPED)
    print(f"zero {robot.received[-1][0] - killed_s:.3f} s after the server was killed")
    status = user.page.get_by_role("banner").get_by_role("status")
    status.get_by_text("Connection lost, trying again").first.wait_for()
    user.page.locator("main.lost").wait_for()
    user.page.keyboard.up("w")
    user.page.keyboard.press("w")  # drives nothing
    before = len(robot.received)
    status.get_by_text("Connected").first.wait_for()
    print(f"connected {time.monotonic() - killed_s:.1f} s after the server was killed")
    user.page.locator("main.lost").wait_for(state="detached")
    assert len(robot.received) == before
    user.page.keyboard.down("s")
    graph.until(lambda: robot.velocities[-1][0] < 0)
    user.page.keyboard.up("s")
    graph.until(lambda: robot.velocities[-1] == STOPPED)
