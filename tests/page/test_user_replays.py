"""A user opens a replay from a folder, without a network: it looks like the page."""

import io
import json
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from tests.page.built_client import needs_client
from tests.page.panel_user import PanelUser
from tests.system.browser import running_page

from trundle.app.cli import main
from trundle.app.play import LogPage, PlayOptions
from trundle.app.recorded_run import open_recording
from trundle.base.diagnostics import Diagnostics
from trundle.base.http.page_address import PageAddress
from trundle.page import PageServer, Session

pytestmark = [pytest.mark.slow, needs_client]
WORLD = """<sdf version="1.6"><world name="w">
<light name="sun" type="directional"><direction>-0.4 0.3 -0.9</direction><diffuse>0.9 0.9 0.9 1</diffuse></light>
<model name="floor"><static>1</static><link name="l"><visual name="v">
<geometry><box><size>6 6 0.1</size></box></geometry>
<material><ambient>0.3 0.3 0.3 1</ambient><diffuse>0.5 0.5 0.5 1</diffuse></material></visual>
<collision name="c"><geometry><box><size>6 6 0.1</size></box></geometry></collision></link></model>
<model name="ball"><pose>0 0 1.5 0 0 0</pose><link name="l"><visual name="v">
<geometry><sphere><radius>0.3</radius></sphere></geometry>
<material><ambient>0.8 0 0 1</ambient><diffuse>1 0 0 1</diffuse></material></visual>
<collision name="c"><geometry><sphere><radius>0.3</radius></sphere></geometry></collision></link></model>
</world></sdf>"""
SIZE = (800, 600)
AT_S = 0.4
VIEW_CANVAS = "canvas[aria-label='3D view']"


@pytest.fixture(scope="module")
def log(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("log")
    (folder / "w.sdf").write_text(WORLD)
    options = ("--headless", "--no-ros", "--duration", "1", "--speed", "max", "--record", str(folder / "run.log"))
    assert main(("run", str(folder / "w.sdf"), *options)) == 0
    return folder / "run.log"


@contextmanager
def played(log: Path) -> Iterator[str]:
    """Play a log on a paused page; yield its address."""
    recorded, simulation = open_recording(log, Diagnostics())
    with PageServer.start(Session(title="t", kind="log", fixed_frame="world"), at=PageAddress(port=0)) as server:
        shown = LogPage(server, recorded, simulation, PlayOptions(paused=True))
        stop = threading.Event()
        thread = threading.Thread(target=shown.run, args=(stop,))
        thread.start()
        try:
            yield server.url
        finally:
            stop.set()
            thread.join()


class ReplayUser:
    """Opens a replay without a network."""

    def __init__(self, browser: Any, url: str) -> None:
        context = browser.new_context(viewport={"width": SIZE[0], "height": SIZE[1]}, offline=True)
        self.page = context.new_page()
        self.faults: list[str] = []
        self.requests: list[str] = []
        self.page.on("pageerror", lambda error: self.faults.append(str(error)))
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.goto(url)
        self.time = self.page.get_by_role("slider", name="Time")
        self.time.wait_for()

    def now(self) -> float:
        return float(self.time.input_value())

    def until(self, condition: Callable[[], bool]) -> None:
        """Wait from outside, as the page's policy forbids waiting inside it."""
        while not condition():
            self.page.wait_for_timeout(20)

    def show(self, time_s: float) -> NDArray[np.uint8]:
        """Seek to a time, and return the picture without the controls."""
        self.time.fill(str(time_s))
        self.page.add_style_tag(content=".replay-bar, .replay-scene > :not(canvas) { opacity: 0 }")
        picture, before = self._picture(), None
        while before is None or not np.array_equal(picture, before) or not _is_drawn(picture):
            self.page.wait_for_timeout(200)
            picture, before = self._picture(), picture
        return picture

    def _picture(self) -> NDArray[np.uint8]:
        return np.asarray(Image.open(io.BytesIO(self.page.screenshot())).convert("RGB"))

    def close(self) -> None:
        self.page.context.close()
        assert self.faults == []
        assert [url for url in self.requests if not url.startswith(("file:", "blob:"))] == []


def _is_drawn(picture: NDArray[np.uint8]) -> bool:
    """False for a single color: the scene is not drawn yet."""
    return bool(picture.std() > 5.0)


def pictured(user: PanelUser, folder: Path) -> NDArray[np.uint8]:
    """Save the view as a picture, and return it."""
    user.page.keyboard.press("Escape")  # without a selection there is no outline
    choose(user, "Save a picture")
    for label, value in zip(("Width [px]", "Height [px]"), SIZE, strict=True):
        user.page.get_by_label(label).fill(str(value))
        user.page.keyboard.press("Tab")
    with user.page.expect_download() as download:
        user.page.get_by_role("button", name="Save as PNG").click()
    download.value.save_as(folder / "picture.png")
    return np.asarray(Image.open(folder / "picture.png").convert("RGB"))


def choose(user: PanelUser, command: str) -> None:
    user.page.keyboard.press("Control+k")
    user.page.get_by_role("combobox", name="Search commands").fill(command)
    user.page.keyboard.press("Enter")


def test_a_replay_looks_like_the_page(log: Path, chromium: Any, tmp_path: Path) -> None:
    """`trundle play` and the replay draw the same picture at one time from one viewpoint."""
    with played(log) as url:
        user = PanelUser(chromium, url)
        user.open("Timeline")
        head = user.page.get_by_role("slider", name="Time")
        head.focus()
        head.press("End")
        user.until(lambda: float(head.get_attribute("aria-valuenow")) == pytest.approx(1.0), what="for the end")
        at_end = pictured(user, tmp_path)
        choose(user, "Share")
        view = user.page.get_by_role("textbox", name="Link").input_value().partition("#")[2]
        user.close()
    assert main(("convert", str(log), "--to", "html", "-o", str(tmp_path / "run.html"))) == 0

    replay = ReplayUser(chromium, f"{(tmp_path / 'run.html').as_uri()}#{view}")
    replayed = replay.show(1.0)
    before = replay.show(AT_S)
    replay.close()

    difference = np.abs(replayed.astype(int) - at_end.astype(int)).max(axis=-1)
    assert (difference > 24).mean() < 0.005, "only the smoothing of edges may differ"
    moved = (np.abs(before.astype(int) - at_end.astype(int)).max(axis=-1) > 24).mean()
    assert moved > 0.01, "the ball is at another position at another time"


def test_the_page_saves_the_last_minutes(chromium: Any, tmp_path: Path) -> None:
    """The replay starts with the user's view and shows the ball falling; so does the glTF file."""
    (tmp_path / "w.sdf").write_text(WORLD)
    with running_page("run", str(tmp_path / "w.sdf"), "--no-ros", environment={}) as url:
        user = PanelUser(chromium, url)
        user.until(lambda: float(user.page.evaluate("performance.now()")) > 3000, what="for some seconds")
        with user.page.expect_download() as download:
            choose(user, "Save a replay")
        download.value.save_as(tmp_path / "run.html")
        with user.page.expect_download() as download:
            choose(user, "Save the last minutes as glTF")
        download.value.save_as(tmp_path / "run.glb")
        user.close()

    heights = _heights(tmp_path / "run.glb")
    assert (heights[0], heights[-1]) == pytest.approx((1.5, 0.35), abs=0.05)
    replay = ReplayUser(chromium, (tmp_path / "run.html").as_uri())
    end = float(replay.time.get_attribute("max"))
    first, last = replay.show(0.0), replay.show(end)
    replay.close()
    assert end > 1.0
    assert (np.abs(first.astype(int) - last.astype(int)).max(axis=-1) > 24).mean() > 0.005, "the ball has fallen"


def _heights(file: Path) -> NDArray[np.float32]:
    """Return the heights of the ball in a GLB's animation [m]."""
    data = file.read_bytes()
    length = int.from_bytes(data[12:16], "little")
    scene = json.loads(data[20 : 20 + length])
    (animation,) = scene["animations"]
    (channel,) = (item for item in animation["channels"] if item["target"]["path"] == "translation")
    assert scene["nodes"][channel["target"]["node"]]["name"] == "ball::l"
    accessor = scene["accessors"][animation["samplers"][channel["sampler"]]["output"]]
    start = 28 + length + scene["bufferViews"][accessor["bufferView"]].get("byteOffset", 0)
    positions = np.frombuffer(data, "<f4", 3 * accessor["count"], start + accessor.get("byteOffset", 0))
    return positions.reshape(-1, 3)[:, 2]


def test_a_replay_plays_and_pauses(log: Path, chromium: Any, tmp_path: Path) -> None:
    assert main(("convert", str(log), "--to", "html", "-o", str(tmp_path / "run.html"))) == 0
    replay = ReplayUser(chromium, (tmp_path / "run.html").as_uri())
    page = replay.page

    replay.until(lambda: replay.now() > 0.05)
    page.get_by_role("combobox", name="Speed").select_option("0.1×")
    page.locator("body").press("Space")
    page.get_by_role("button", name="Play").wait_for()
    paused_at = replay.now()
    page.wait_for_timeout(300)
    assert replay.now() == paused_at
    page.get_by_role("button", name="Play").click()
    replay.until(lambda: replay.now() != paused_at)
    replay.close()
