"""The page of a simulation that a program steps."""

import asyncio
import http.server
import json
import struct
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.page.built_client import needs_client
from tests.page_client import ProtocolClient

import trundle

PATIENCE_MS = 60_000


def _world() -> trundle.World:
    world = trundle.World("yard")
    world.add_light()
    world.add_ground_plane()
    world.add_box("box", (0.5, 0.5, 0.5), pose=(0, 0, 0.25), color=(1, 0, 0))
    return world


@pytest.fixture
def sim() -> Iterator[trundle.LoadedSimulation]:
    with trundle.load(_world()) as sim:
        yield sim


def _request(client: ProtocolClient, work: Callable[[], object], request: str, **fields: Any) -> None:
    """Send a request, and do work that answers it."""
    number = len(client.jsons) + 1000
    client.send("trundle/request", id=number, request=request, **fields)
    while not any(message.get("id") == number for message in client.jsons):
        work()
        client.read(0.01)
    (answer,) = [message for message in client.jsons if message.get("id") == number]
    assert answer["ok"], answer


def _last_time_ns(client: ProtocolClient) -> int:
    return int(struct.unpack_from("<Q", client.payloads("trundle/poses")[-1])[0])


def test_a_program_shows_its_simulation_and_answers_the_page(sim: trundle.LoadedSimulation) -> None:
    """`run` sends the poses while it runs, `sync` what was set; a person's step, reset and speed reach the program."""
    view = sim.view(speed=None, port=None)
    assert sim.view() is view
    with ProtocolClient(view.url) as client:
        for topic in ("trundle/world", "trundle/poses", "trundle/state"):
            client.subscribe(topic)
        while not client.payloads("trundle/poses"):
            view.sync()
            client.read(0.01)
        assert json.loads(client.payloads("trundle/world")[-1])["name"] == "yard"
        assert view.is_watched

        sim.run(1.0)
        client.until(lambda: _last_time_ns(client) == 1_000_000_000)
        sim["box"].set_pose((2, 0, 0.25))
        view.sync()
        client.until(lambda: struct.pack("<f", 2.0) in client.payloads("trundle/poses")[-1])

        _request(client, view.sync, "speed", factor=20.0)
        assert view.speed == 20.0
        _request(client, view.sync, "reset", what="all")
        assert sim["box"].pose.position[0] == 0.0
    view.close()
    assert not view.is_open
    sim.run(0.1)
    view.sync()
    assert sim.time_s == pytest.approx(0.1)


@pytest.mark.slow
def test_a_paused_page_holds_the_program(sim: trundle.LoadedSimulation) -> None:
    view = sim.view(speed=None)
    with ProtocolClient(view.url) as client:
        client.subscribe("trundle/state")
        client.send("trundle/request", id=1, request="pause")
        held: list[int] = []

        def step_and_play() -> None:
            client.until(lambda: any(message.get("id") == 1 for message in client.jsons))
            held.append(sim.time_ns)
            client.send("trundle/request", id=2, request="step", count=3)
            client.until(lambda: any(message.get("id") == 2 for message in client.jsons))
            while sim.time_ns == held[0]:
                time.sleep(0.01)
            held.append(sim.time_ns)
            client.send("trundle/request", id=3, request="play")

        person = threading.Thread(target=step_and_play)
        person.start()
        while not view.is_paused and not held:
            sim.step()
        sim.run(0.5)
        person.join()
        assert held[1] == held[0] + 3_000_000
        assert not view.is_paused
        assert sim.time_ns >= held[1]


@pytest.mark.slow
def test_speed_is_held_and_measured(sim: trundle.LoadedSimulation) -> None:
    with sim.view(speed=4.0) as view:
        start = time.monotonic()
        sim.run(2.0)
        assert time.monotonic() - start > 0.4  # at most the speed; a slow machine takes longer
        assert view.real_time_factor is not None
        assert 0.0 < view.real_time_factor < 5.0
        with pytest.raises(trundle.UsageError, match=r"^speed \[simulated s per s\] must be a finite number of 0.001"):
            view.speed = 0.0


@pytest.mark.slow
def test_a_notebook_answers_between_two_cells(sim: trundle.LoadedSimulation) -> None:
    """A kernel runs its cells in an event loop, which is idle between them."""

    async def cells() -> None:
        view = sim.view()
        with ProtocolClient(view.url) as client:
            client.send("trundle/request", id=1, request="step", count=5)
            while not any(message.get("id") == 1 for message in client.jsons) or sim.steps < 5:
                await asyncio.sleep(0.02)
                client.read(0.001)
        view.close()
        await asyncio.sleep(0.1)

    asyncio.run(cells())
    assert sim.steps == 5


@pytest.mark.slow
def test_load_opens_the_page_and_close_closes_it() -> None:
    with trundle.load(_world(), page=True) as sim:
        view = sim.view()
        assert view.url.startswith("http://127.0.0.1:")
        assert f'src="{view.url}"' in view._repr_html_()
    assert not view.is_open
    assert view._repr_html_() == "<p>The view is closed.</p>"


def test_only_servers_of_jupyter_may_frame_a_page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from trundle.live.notebook import notebook_origins

    monkeypatch.setenv("JUPYTER_RUNTIME_DIR", str(tmp_path))
    (tmp_path / "jpserver-1.json").write_text(json.dumps({"url": "http://localhost:8888/lab", "token": "x"}))
    (tmp_path / "nbserver-2.json").write_text(json.dumps({"url": "https://lab.example:9000/"}))
    (tmp_path / "jpserver-3.json").write_text("{")
    (tmp_path / "jpserver-4.json").write_text(json.dumps({"url": "http://a;script-src *:1/"}))
    assert notebook_origins() == ()
    monkeypatch.setitem(sys.modules, "ipykernel", object())
    assert notebook_origins() == ("http://localhost:8888", "http://127.0.0.1:8888", "https://lab.example:9000")


_SCRIPT = """
import trundle
world = trundle.World("yard")
world.add_light()
world.add_ground_plane()
world.add_box("box", (0.5, 0.5, 0.5), pose=(0, 0, 0.25), color=(1, 0, 0))
with trundle.load(world) as sim:
    view = sim.view()
    print(view.url, flush=True)
    while view.is_open and sim.time_s < 600:
        sim["box"].set_pose((0, 0, 0.25 + sim.time_s % 2))
        sim.run(0.02)
        view.sync()
"""


@pytest.fixture
def script() -> Iterator[str]:
    """Start a program that moves a box; the link of its page."""
    with subprocess.Popen([sys.executable, "-c", _SCRIPT], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        yield process.stdout.readline().strip()
        process.kill()


@pytest.mark.slow
@pytest.mark.browser
@needs_client
def test_a_person_sees_what_a_script_moves_and_pauses_it(script: str, chromium: Any) -> None:
    page = chromium.new_page(viewport={"width": 1000, "height": 640})
    page.set_default_timeout(PATIENCE_MS)
    page.goto(script)
    page.get_by_label("Connected").first.wait_for()
    page.get_by_role("button", name="Pause").first.click()
    page.get_by_role("button", name="Play").first.wait_for()
    page.get_by_role("treeitem", name="box").first.wait_for()
    page.close()


@pytest.mark.slow
@pytest.mark.browser
@needs_client
def test_a_notebook_shows_the_page_inline(
    sim: trundle.LoadedSimulation, chromium: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A server at localhost stands for Jupyter's: its page has the view's HTML, as an output cell has."""
    html: list[str] = []

    class Notebook(http.server.BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            self.send_response(200)
            self.send_header("Content-Type", "text/html")
            self.end_headers()
            self.wfile.write(f"<!doctype html><h1>Notebook</h1>{html[0]}".encode())

        def log_message(self, format: str, *_: object) -> None: ...

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Notebook)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    (tmp_path / "jpserver-1.json").write_text(json.dumps({"url": f"http://localhost:{server.server_port}/"}))
    monkeypatch.setenv("JUPYTER_RUNTIME_DIR", str(tmp_path))
    monkeypatch.setitem(sys.modules, "ipykernel", object())
    view = sim.view()
    html.append(view._repr_html_())
    try:
        for host in ("localhost", "127.0.0.1"):
            page = chromium.new_page(viewport={"width": 1300, "height": 800})
            page.set_default_timeout(PATIENCE_MS)
            page.goto(f"http://{host}:{server.server_port}/")
            frame = page.frame_locator("iframe")
            frame.get_by_label("Connected").first.wait_for()
            while not frame.get_by_role("treeitem", name="box").count():
                view.sync()
                page.wait_for_timeout(20)
            page.close()
    finally:
        server.shutdown()
        server.server_close()
