"""A run goes on, and its page comes back, when the page's server is killed."""

import json
import os
import signal
import time
from contextlib import suppress
from pathlib import Path

import pytest
from tests.page_client import ProtocolClient
from tests.system.browser import running_page
from websockets.exceptions import ConnectionClosed, InvalidHandshake

WORLD = '<sdf version="1.6"><world name="yard"><model name="mast"><link name="l"/></model></world></sdf>'


def _child(parent: int, word: str) -> int | None:
    """Return the process below another one whose command line has a word."""
    for folder in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):
            words, status = (folder / "cmdline").read_bytes(), (folder / "stat").read_text()
            if int(status.rpartition(")")[2].split()[1]) == parent:
                child = int(folder.name)
                found = child if word.encode() in words else _child(child, word)
                if found is not None:
                    return found
    return None


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="finds the server's process in /proc")
def test_a_run_goes_on_with_its_world_on_the_page(tmp_path: Path) -> None:
    (tmp_path / "yard.sdf").write_text(WORLD)
    words = ("run", "yard.sdf", "--port", "0", "--no-browser", "--no-ros")
    with running_page(*words, environment={"HOME": str(tmp_path)}, folder=tmp_path) as url:
        with ProtocolClient(url) as client:
            client.subscribe("trundle/state")
            client.until(lambda: client.payloads("trundle/state"))
            before = json.loads(client.payloads("trundle/state")[-1])["time_ns"]
            server = _child(os.getpid(), "trundle.page.server")
            assert server is not None
            os.kill(server, signal.SIGKILL)
            with pytest.raises(ConnectionClosed):
                client.settle(60)
        end = time.monotonic() + 60
        while True:
            assert time.monotonic() < end, "the page does not come back"
            with suppress(OSError, InvalidHandshake, ConnectionClosed):  # the last: accepted by the server that died
                again = ProtocolClient(url)
                break
        with again:
            for topic in ("trundle/world", "trundle/state"):
                again.subscribe(topic)
            again.until(lambda: again.payloads("trundle/world"))
            assert [model["name"] for model in json.loads(again.payloads("trundle/world")[-1])["models"]] == ["mast"]
            again.until(lambda: [s for s in again.payloads("trundle/state") if json.loads(s)["time_ns"] > before])
            again.send("trundle/request", id=1, request="pause")
            again.until(lambda: json.loads(again.payloads("trundle/state")[-1])["paused"])
