"""Reloading a changed world from the page."""

import json
import re
from pathlib import Path
from typing import Any

from tests.page_client import ProtocolClient

_MODEL = '<model name="{}"><pose>0 0 0.5 0 0 0</pose><link name="l"/></model>'


def _write(file: Path, world: str, *models: str) -> None:
    inside = "".join(map(_MODEL.format, models))
    file.write_text(f'<sdf version="1.6"><world name="{world}">{inside}</world></sdf>')


def _reload(client: ProtocolClient, number: int) -> dict[str, Any]:
    client.send("trundle/request", id=number, request="reload")
    client.until(lambda: any(message.get("id") == number for message in client.jsons))
    return next(message for message in client.jsons if message.get("id") == number)


def test_a_changed_world_replaces_the_running_world(start, trundle, master, until, tmp_path) -> None:
    """Models, name and topics change; an invalid file is refused with its line, and the old world continues."""
    file = tmp_path / "w.sdf"
    _write(file, "first", "one")
    running = start("run", str(file), "--port", "0")
    until("the page", lambda: "see it at" in running.output())
    (url,) = re.findall(r"see it at (\S+)", running.output())
    with ProtocolClient(url) as client:
        for topic in ("trundle/world", "trundle/session"):
            client.subscribe(topic)

        def worlds() -> list[tuple[str, list[str]]]:
            manifests = map(json.loads, client.payloads("trundle/world"))
            return [(world["name"], [model["name"] for model in world["models"]]) for world in manifests]

        client.until(lambda: worlds() == [("first", ["one"])])
        _write(file, "second", "one", "two")
        assert _reload(client, 1)["ok"] is True
        client.until(lambda: worlds()[-1] == ("second", ["one", "two"]))
        client.until(lambda: json.loads(client.payloads("trundle/session")[-1])["title"] == "second")

        file.write_text("<sdf version='1.6'><world name='third'>")
        refused = _reload(client, 2)
        assert refused["ok"] is False
        assert "w.sdf:1" in refused["error"]
        client.subscribe("trundle/state")
        client.until(lambda: len(client.payloads("trundle/state")) > 3)
        assert worlds()[-1][0] == "second"

    until("the clock of the second world", lambda: "/clock" in dict(master.call("getTopicTypes")))
    assert trundle("topic", "echo", "-n1", "/clock").returncode == 0
    assert trundle("node", "list").stdout.split().count("/trundle") == 1
    assert running.interrupt() == 130


def test_reload_with_a_recording_is_refused(start, until, tmp_path) -> None:
    file = tmp_path / "w.sdf"
    _write(file, "first", "one")
    running = start("run", str(file), "--port", "0", "--no-ros", "--record", "run.log")
    until("the page", lambda: "see it at" in running.output())
    (url,) = re.findall(r"see it at (\S+)", running.output())
    with ProtocolClient(url) as client:
        assert "start it without --record" in _reload(client, 1)["error"]


_ROBOT = """<robot name="cart"><link name="base"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><origin xyz="0 0 {height}"/><geometry><box size="1 1 0.2"/></geometry></collision></link>
<gazebo><plugin name="move" filename="libgazebo_ros_planar_move.so"><commandTopic>go</commandTopic></plugin></gazebo>
</robot>"""
_LAUNCH = """<launch>
<param name="robot_description" command="xacro $(dirname)/robot.xacro"/>
<node pkg="gazebo_ros" type="gzserver" name="gazebo" args="$(dirname)/w.world"/>
<node pkg="gazebo_ros" type="gzclient" name="gzclient"/>
<node pkg="gazebo_ros" type="spawn_model" name="spawn" args="-urdf -param robot_description -model cart"/>
</launch>"""


def _world_of(client: ProtocolClient) -> list[str]:
    manifests = list(map(json.loads, client.payloads("trundle/world")))
    return [model["name"] for model in manifests[-1]["models"]] if manifests else []


def _request(client: ProtocolClient, number: int, request: str, **fields: Any) -> dict[str, Any]:
    client.send("trundle/request", id=number, request=request, **fields)
    client.until(lambda: any(message.get("id") == number for message in client.jsons))
    return next(message for message in client.jsons if message.get("id") == number)


def _state(client: ProtocolClient) -> dict[str, Any]:
    client.until(lambda: client.payloads("trundle/state"))
    return json.loads(client.payloads("trundle/state")[-1])


def test_a_launch_reloads_its_changed_files(start, master, until, tmp_path) -> None:
    """The page stays open; description, world and nodes are read from the changed files, after seeking, too."""
    (tmp_path / "robot.launch").write_text(_LAUNCH)
    (tmp_path / "robot.xacro").write_text(_ROBOT.format(height=0.1))
    _write(tmp_path / "w.world", "first", "one")
    running = start("launch", "robot.launch", "--view-port", "0")
    until("the page", lambda: "see it at" in running.output())
    (url,) = re.findall(r"see it at (\S+)", running.output())
    with ProtocolClient(url) as client:
        for topic in ("trundle/world", "trundle/session", "trundle/state"):
            client.subscribe(topic)
        client.until(lambda: _world_of(client) == ["one", "cart"])
        client.until(lambda: _state(client)["time_ns"] > 2_000_000_000)
        begin = _state(client)["timeline"]["start_ns"]
        assert _request(client, 1, "pause")["ok"] is True
        assert _request(client, 2, "seek", time_ns=begin)["ok"] is True
        client.until(lambda: _state(client)["time_ns"] == begin)

        (tmp_path / "w.world").write_text("<sdf version='1.6'><world name='third'>")
        refused = _request(client, 3, "reload")
        assert refused["ok"] is False
        assert "w.world:1" in refused["error"]
        _write(tmp_path / "w.world", "second", "two")
        (tmp_path / "robot.xacro").write_text(_ROBOT.format(height=0.2))
        assert _request(client, 4, "reload")["ok"] is True
        client.until(lambda: _world_of(client) == ["two", "cart"])
        client.until(lambda: json.loads(client.payloads("trundle/session")[-1])["title"] == "second")
        client.until(lambda: _state(client)["paused"] is False)
    assert "0 0 0.2" in master.call("getParam", "/robot_description")
    assert "the launch is loaded again" in running.output()
    assert running.output().count("see it at") == 1
    assert running.interrupt() == 130


def test_gzserver_reloads_its_world_with_spawned_models(start, trundle, until, tmp_path) -> None:
    """The world's models are read from the changed file; models of spawn_model are spawned again."""
    _write(tmp_path / "w.world", "first", "one")
    (tmp_path / "box.sdf").write_text(f'<sdf version="1.6">{_MODEL.format("box")}</sdf>')
    running = start("--as", "gazebo", "w.world")
    until("the page", lambda: "see it at" in running.output())
    (url,) = re.findall(r"see it at (\S+)", running.output())
    assert (
        trundle("--as", "rosrun", "gazebo_ros", "spawn_model", "-sdf", "-file", "box.sdf", "-model", "box").returncode
        == 0
    )
    with ProtocolClient(url) as client:
        for topic in ("trundle/world", "trundle/state"):
            client.subscribe(topic)
        client.until(lambda: _world_of(client) == ["one", "box"])
        _write(tmp_path / "w.world", "second", "two")
        assert _request(client, 1, "reload")["ok"] is True
        client.until(lambda: _world_of(client) == ["two", "box"])
        client.until(lambda: _state(client)["timeline"]["end_ns"] > 0)
    assert running.output().count("see it at") == 1
    assert running.interrupt() == 0
