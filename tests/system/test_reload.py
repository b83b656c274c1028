"""A world that is loaded again from the page, after its file has changed."""

import json
import re
from pathlib import Path
from typing import Any

from tests.page_client import ProtocolClient

_MODEL = '<model name="{}"><pose>0 0 0.5 0 0 0</pose><link name="l"/></model>'


def _write(file: Path, world: str, *models: str) -> None:
    inside = "".join(map(_MODEL.format, models))
    file.write_text(f'<sdf version="1.6"><world name="{world}">{inside}</world></sdf>')


def _ask(client: ProtocolClient, number: int) -> dict[str, Any]:
    client.send("trundle/request", id=number, request="reload")
    client.until(lambda: any(each.get("id") == number for each in client.jsons))
    return next(each for each in client.jsons if each.get("id") == number)


def test_a_changed_world_replaces_the_one_that_runs(start, trundle, master, until, tmp_path) -> None:
    """Its models, its name and its topics; a broken file is refused with its line, and the world goes on."""
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
            return [(each["name"], [model["name"] for model in each["models"]]) for each in manifests]

        client.until(lambda: worlds() == [("first", ["one"])])
        _write(file, "second", "one", "two")
        assert _ask(client, 1)["ok"] is True
        client.until(lambda: worlds()[-1] == ("second", ["one", "two"]))
        client.until(lambda: json.loads(client.payloads("trundle/session")[-1])["title"] == "second")

        file.write_text("<sdf version='1.6'><world name='third'>")
        refused = _ask(client, 2)
        assert refused["ok"] is False
        assert "w.sdf:1" in refused["error"]
        client.subscribe("trundle/state")
        client.until(lambda: len(client.payloads("trundle/state")) > 3)
        assert worlds()[-1][0] == "second"

    until("the clock of the second world", lambda: "/clock" in dict(master.call("getTopicTypes")))
    assert trundle("topic", "echo", "-n1", "/clock").returncode == 0
    assert trundle("node", "list").stdout.split().count("/trundle") == 1
    assert running.interrupt() == 130


def test_what_cannot_be_loaded_again_says_why(start, until, tmp_path) -> None:
    file = tmp_path / "w.sdf"
    _write(file, "first", "one")
    running = start("run", str(file), "--port", "0", "--no-ros", "--record", "run.log")
    until("the page", lambda: "see it at" in running.output())
    (url,) = re.findall(r"see it at (\S+)", running.output())
    with ProtocolClient(url) as client:
        assert "start it without --record" in _ask(client, 1)["error"]
