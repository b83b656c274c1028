"""Page of a graph: windows of nodes appear on the page, and requests of users reach the nodes."""

import asyncio
import json
import time
import urllib.request
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import aiohttp
import pytest
from tests.page_client import page_url

from trundle.base.http.page_address import PageAddress
from trundle.gazebo.nodes import Slider
from trundle.page import GraphAddress
from trundle.page.graph_page import GraphPage
from trundle.page.shared_page import SharedPage
from trundle.ros import Core, GraphLoop, Node

_PATIENCE_S = 60.0


@dataclass
class Shown:
    loop: GraphLoop
    page: GraphPage
    rviz: Node
    config: Path
    lines: list[str] = field(default_factory=list)
    result: "Future[int] | None" = None

    def start(self) -> None:
        """Show the page and wait for its URL."""
        self.result = self.loop.spawn(self.page.show(self.rviz, config=str(self.config)))
        _wait(lambda: self.page.url is not None)

    def session(self) -> dict[str, Any]:
        with urllib.request.urlopen(page_url(str(self.page.url), "/session.json")) as answer:
            return json.load(answer)

    def request(self, **request: object) -> dict[str, Any]:
        """Make one request as the client does; return the response."""

        async def ask() -> dict[str, Any]:
            async with (
                aiohttp.ClientSession() as http,
                http.ws_connect(str(self.page.url), protocols=("trundle.v1",)) as socket,
            ):
                await socket.send_json({"op": "trundle/request", "id": 7, **request})
                async for message in socket:
                    if message.type is aiohttp.WSMsgType.TEXT:
                        data = json.loads(message.data)
                        if data["op"] == "trundle/response":
                            return data
            raise AssertionError("closed without a response")

        with ThreadPoolExecutor(1) as thread:  # a browser's test leaves a loop in this one
            return thread.submit(asyncio.run, asyncio.wait_for(ask(), _PATIENCE_S)).result()


def _wait(is_so: Any) -> None:
    deadline = time.monotonic() + _PATIENCE_S
    while not is_so():
        assert time.monotonic() < deadline
        time.sleep(0.02)


@pytest.fixture
def shown(tmp_path: Path) -> Iterator[Shown]:
    config = tmp_path / "car.rviz"
    config.write_text("Visualization Manager:\n  Class: ''\n")
    with GraphLoop() as loop:
        core = Core(loop=loop, port=0)
        loop.run(core.start())
        rviz = Node("rviz", loop=loop, master_uri=core.uri)
        lines: list[str] = []
        page = GraphPage(SharedPage(say=lines.append, at=PageAddress(port=0), graph=GraphAddress(master_uri=core.uri)))
        shown = Shown(loop, page, rviz, config, lines)
        yield shown
        page.close()
        loop.run(shown.rviz.shutdown())
        loop.run(core.stop())


def test_the_session_has_the_windows_of_the_nodes(shown: Shown) -> None:
    page = shown.page
    page.open_panel("rqt_graph")
    page.drive_on("/base/cmd_vel")
    page.drive_on("/second")
    page.show_image("/camera/image_raw")
    page.plot(["/odom/twist/twist/linear/x"])
    shown.start()
    page.open_panel("rqt_console")

    address = str(page.url).replace("http", "ws")
    assert shown.lines[0] == f"see it at {page.url}"
    assert shown.lines[1].startswith(f"Foxglove connects to {address}")
    _wait(lambda: "rqt_console" in shown.session()["panels"])
    session = shown.session()
    assert session["kind"] == "graph"
    assert session["panels"] == ["rqt_graph", "rqt_plot", "rqt_console"]
    assert session["drive_topic"] == "/base/cmd_vel"
    assert session["images"] == ["/camera/image_raw"]
    assert session["plots"] == ["/odom/twist/twist/linear/x"]
    assert session["rviz"] == {"name": "car.rviz", "text": shown.config.read_text(), "writable": True, "saved": False}


def test_the_session_has_the_rviz_nodes_namespace_and_remappings(shown: Shown) -> None:
    shown.loop.run(shown.rviz.shutdown())
    shown.rviz = Node(
        "rviz",
        namespace="/robot",
        loop=shown.loop,
        master_uri=shown.rviz.master_uri,
        remappings={"scan": "front/scan", "/tf": "tf"},
    )
    shown.start()

    session = shown.session()
    assert session["namespace"] == "/robot"
    assert session["remappings"] == {"/robot/scan": "/robot/front/scan", "/tf": "/robot/tf"}


def test_sliders_and_joysticks_call_their_nodes(shown: Shown) -> None:
    moved: list[tuple[str, float]] = []
    sticks: list[tuple[list[float], list[int]]] = []
    shown.page.offer_sliders(
        [Slider(name="pan", lower=-1.0, upper=1.0, position=0.25)], lambda name, at: moved.append((name, at))
    )
    shown.page.offer_joystick(lambda axes, buttons: sticks.append((list(axes), list(buttons))))
    shown.start()

    assert shown.session()["sliders"] == [{"name": "pan", "lower": -1.0, "upper": 1.0, "position": 0.25}]
    assert shown.request(request="slider", joint="pan", position=0.5)["ok"] is True
    assert shown.request(request="joystick", axes=[0.5, -1.0], buttons=[1])["ok"] is True
    assert moved == [("pan", 0.5)]
    assert sticks == [([0.5, -1.0], [1])]
    refused = shown.request(request="slider", joint="tilt", position=0.5)
    assert (refused["ok"], refused["error"]) == (False, "no slider for joint 'tilt'")


def test_a_joystick_that_is_not_renewed_returns_to_rest(shown: Shown) -> None:
    """As of a browser that was killed, or a page that hangs."""
    sticks: list[tuple[list[float], list[int]]] = []
    shown.page.offer_joystick(lambda axes, buttons: sticks.append((list(axes), list(buttons))))
    shown.start()

    for _ in range(3):
        assert shown.request(request="joystick", axes=[0.5, -1.0], buttons=[1])["ok"] is True
    assert len(sticks) == 3

    _wait(lambda: len(sticks) == 4)
    assert sticks[-1] == ([0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0], [0] * 11)
    shown.page.close()
    assert len(sticks) == 4


def test_the_configuration_is_saved_to_its_file(shown: Shown) -> None:
    shown.start()

    assert shown.request(request="save_rviz", text="Panels: []\n")["ok"] is True
    assert shown.config.read_text() == "Panels: []\n"
    _wait(lambda: shown.session()["rviz"]["text"] == "Panels: []\n")


def test_requests_to_a_simulation_are_refused_with_a_reason(shown: Shown) -> None:
    shown.start()

    response = shown.request(request="step", count=1)
    assert response["ok"] is False
    assert response["error"].startswith("this page shows a ROS graph: it has no simulation")


def test_the_page_ends_with_its_server(shown: Shown) -> None:
    shown.start()
    shown.page.close()

    assert shown.result is not None
    assert shown.result.result(_PATIENCE_S) == 0
    assert shown.page.is_over
    assert shown.page.url is None
