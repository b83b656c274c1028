"""A user opens the page over a slow line, and from another machine, whose browser restricts plain http."""

import re
import socket
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import pytest
from tests.graphs import Graph, running_graph
from tests.page.built_client import needs_client
from tests.page.driving.test_driving import Robot
from tests.page.panel_user import PATIENCE_MS, PanelUser
from tests.system.browser import running_page

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, Session

pytestmark = [needs_client, pytest.mark.slow]
BOX = "<geometry><box><size>0.5 0.5 0.5</size></box></geometry>"
TROLLEY = f"""<sdf version="1.6"><model name="trolley"><link name="base"><collision name="c">{BOX}</collision>
<visual name="v">{BOX}</visual></link></model></sdf>"""


def test_loading_shows_its_progress(chromium: Any, tmp_path: Path) -> None:
    """The world's file is delayed; the tab's title is the robot's name from the start."""
    (tmp_path / "model.sdf").write_text(TROLLEY)
    words = ("run", "model.sdf", "--no-ros", "--pause", "--port", "0")
    with running_page(*words, environment={"HOME": str(tmp_path)}, folder=tmp_path) as url:
        tab = chromium.new_page()
        tab.set_default_timeout(PATIENCE_MS)
        routes: list[Any] = []

        def hold(route: Any) -> None:
            routes.append(route)

        tab.route(re.compile(r"\.glb"), hold)
        tab.goto(url)
        bar = tab.get_by_role("progressbar", name="Loading the world")
        bar.wait_for()
        assert bar.evaluate("bar => bar.value") < 1
        tab.get_by_text(re.compile(r"^Loading ")).wait_for()
        tab.get_by_text(re.compile(r"^\d+ %$")).wait_for()
        assert tab.title() == "trolley"
        for route in routes:
            route.continue_()
        tab.unroute(re.compile(r"\.glb"))
        bar.wait_for(state="detached")
        assert routes
        tab.close()


def _own_address() -> str:
    """Return this machine's address on its network; nothing is sent."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(("198.51.100.1", 9))
        except OSError:
            pytest.skip("this machine is on no network")
        return str(probe.getsockname()[0])


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


def test_a_user_on_another_machine_drives_and_sees_the_browsers_restrictions(chromium: Any, graph: Graph) -> None:
    node = graph.node("robot_base")
    robot = Robot(node, "/cmd_vel")
    session = Session(title="t", kind="graph", drive_topic="/cmd_vel", joystick=True)
    address = GraphAddress(master_uri=graph.core.uri)
    at = PageAddress(host="0.0.0.0", port=0)
    with PageServer.start(session, at=at, graph=address, node=node) as server:
        parts = urlsplit(server.url)
        user = PanelUser(chromium, parts._replace(netloc=f"{_own_address()}:{parts.port}").geturl())
        assert user.page.evaluate("isSecureContext") is False
        user.page.locator(".disc").focus()
        user.page.keyboard.down("w")
        user.until(lambda: robot.velocities and robot.velocities[-1][0] > 0.0, what="for it to drive")
        user.page.keyboard.up("w")
        user.until(lambda: robot.velocities[-1] == (0.0, 0.0), what="for it to stop")
        user.open("Joystick")
        user.sees("Browsers show gamepads only to pages that come by https or from localhost: drag the sticks.")
        user.page.keyboard.press("Control+k")
        user.page.get_by_role("combobox", name="Search commands").fill("Share")
        user.page.keyboard.press("Enter")
        user.page.get_by_role("dialog").get_by_role("button", name="Select", exact=True).click()
        link = user.field("Link")
        assert link.evaluate("field => field.selectionEnd - field.selectionStart") == len(link.input_value())
        user.page.keyboard.press("Escape")
        user.close()
