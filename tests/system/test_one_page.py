"""The page of a launch with Gazebo and rviz: simulated world and displays of rviz's file."""

import json
import re
from pathlib import Path
from typing import Any

import pytest
from tests.page_client import ProtocolClient
from tests.system.browser import opened, running_page, until

_RVIZ = {
    "Visualization Manager": {
        "Displays": [{"Class": "rviz/Axes", "Name": "Where the world begins", "Enabled": True, "Length": 1}],
        "Global Options": {"Fixed Frame": "map"},
        "Views": {"Current": {"Class": "rviz/Orbit", "Distance": 6, "Pitch": 0.6, "Yaw": 0.8}},
    }
}
_WORLD = """<sdf version="1.6"><world name="default">
<model name="post"><static>true</static><link name="l"><hue>3</hue></link></model></world></sdf>"""
_LAUNCH = """<launch><include file="$(find gazebo_ros)/launch/empty_world.launch">
<arg name="world_name" value="$(dirname)/yard.world"/></include>
<node pkg="rviz" type="rviz" name="see" args="-d $(dirname)/see.rviz"/>
<node pkg="joy" type="joy_node" name="stick"/></launch>"""


@pytest.fixture
def launch(tmp_path: Path) -> str:
    (tmp_path / "see.rviz").write_text(json.dumps(_RVIZ))  # JSON is YAML
    (tmp_path / "yard.world").write_text(_WORLD)
    (tmp_path / "both.launch").write_text(_LAUNCH)
    return str(tmp_path / "both.launch")


def test_gazebo_and_rviz_are_on_one_page(start: Any, until: Any, launch: str, env: dict[str, str]) -> None:
    """Requests to the simulation and to nodes of the graph are answered."""
    port = env["ROS_MASTER_URI"].rpartition(":")[2]
    running = start("launch", launch, "--port", port, "--view-port", "0")
    until("the table", lambda: "WHAT RUNS" in running.output() and "  page " in running.output())
    urls = set(re.findall(r"http://127\.0\.0\.1:\d+/\?token=[\w-]+", running.output()))
    assert len(urls) == 1, running.output()
    with ProtocolClient(urls.pop()) as client:
        for topic in ("trundle/world", "trundle/session", "trundle/state"):
            client.subscribe(topic)

        def session() -> dict[str, Any]:
            return json.loads((client.payloads("trundle/session") or [b"{}"])[-1])

        client.until(lambda: session().get("kind") == "simulation")
        client.until(lambda: client.payloads("trundle/world"))
        assert session()["title"] == "yard"
        assert session()["rviz"]["name"] == "see.rviz"
        assert session()["fixed_frame"] is None  # the file has one
        requests: tuple[dict[str, Any], ...] = (
            {"request": "pause"},
            {"request": "joystick", "axes": [0.5, 0.0], "buttons": [1]},
            {"request": "save_rviz", "text": "Panels: []\n"},
        )
        for number, request in enumerate(requests):
            client.send("trundle/request", id=number, **request)

        def responses() -> dict[int, bool]:
            return {m["id"]: m["ok"] for m in client.jsons if m["op"] == "trundle/response"}

        client.until(lambda: len(responses()) == len(requests))
        assert responses() == dict.fromkeys(range(len(requests)), True)
        client.until(lambda: any(json.loads(state)["paused"] for state in client.payloads("trundle/state")))
    assert Path(launch).with_name("see.rviz").read_text() == "Panels: []\n"
    assert running.interrupt() == 130


@pytest.mark.browser
@pytest.mark.slow
def test_the_page_has_the_world_and_the_displays(chromium: Any, launch: str, tmp_path: Path) -> None:
    words = ("launch", launch, "--port", "0", "--view-port", "0")
    with running_page(*words, environment={"HOME": str(tmp_path)}) as url, opened(chromium, url) as page:
        page.get_by_text("post").first.wait_for()
        page.get_by_role("tab", name="Displays").first.click()
        page.get_by_text("Where the world begins").first.wait_for()
        page.get_by_role("button", name="Pause", exact=True).first.click()
        page.get_by_role("button", name="Play", exact=True).first.wait_for()
        until(page, lambda: page.get_by_label("Fixed Frame").first.input_value() == "map", "the file's frame")
        page.get_by_role("button", name="Details").click()
        page.get_by_role("dialog").get_by_text("yard.world:2: <hue>").wait_for()
