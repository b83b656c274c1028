"""A user saves the view: as a picture, a video, a link."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from tests.graphs import Graph, running_graph
from tests.page.built_client import needs_client
from tests.page.scene_user import PX_PER_M, VIEW_CANVAS, SceneUser, rviz_text
from tests.video_file import read_video

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, Session
from trundle.page.session import RvizFile

pytestmark = [pytest.mark.slow, needs_client]

SQUARE = {"Class": "rviz/Marker", "Name": "Cube", "Enabled": True, "Marker Topic": "/square"}
GREEN = (0, 255, 0)


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


@pytest.fixture(scope="module")
def url(graph: Graph) -> Iterator[str]:
    """Yield a page that shows a green square of 0.4 m in the middle."""
    message: dict[str, Any] = {"type": 1, "header": {"frame_id": "map"}, "color": {"g": 1.0, "a": 1.0}}
    message |= {"scale": {"x": 0.4, "y": 0.4, "z": 0.4}, "pose": {"orientation": {"w": 1.0}}}
    graph.node("square").advertise("/square", "visualization_msgs/Marker", latch=True).publish(message)
    session = Session(title="t", kind="graph", rviz=RvizFile(name="t.rviz", text=rviz_text(SQUARE), writable=False))
    with PageServer.start(session, at=PageAddress(port=0), graph=GraphAddress(master_uri=graph.core.uri)) as server:
        yield server.url


@pytest.fixture
def user(chromium: Any, url: str) -> Iterator[SceneUser]:
    user = SceneUser(chromium, url)
    user.until(lambda: user.sees_at((0.0, 0.0)), what="for the square")
    yield user
    user.close()


def _choose(user: SceneUser, command: str) -> None:
    user.page.keyboard.press("Control+k")
    user.page.get_by_role("combobox", name="Search commands").fill(command)
    user.page.keyboard.press("Enter")


def _drag_view(user: SceneUser, right_px: int, down_px: int) -> None:
    x, y = user.at((0.5, 0.5))
    user.page.mouse.move(x, y)
    user.page.mouse.down(button="middle")
    user.page.mouse.move(x + right_px, y + down_px, steps=5)
    user.page.mouse.up(button="middle")


def _green(picture: NDArray[np.uint8]) -> tuple[float, float, float]:
    """Return the green fraction of the picture, and its middle as fractions of width and height."""
    rows, columns = np.nonzero((np.abs(picture[:, :, :3].astype(int) - GREEN) < 100).all(axis=-1))
    height, width = picture.shape[:2]
    return len(rows) / (width * height), float(columns.mean() / width), float(rows.mean() / height)


def test_a_picture_is_saved_in_any_size(user: SceneUser, tmp_path: Path) -> None:
    _choose(user, "Save a picture")
    for label, value in (("Width [px]", "2000"), ("Height [px]", "1520")):
        user.page.get_by_label(label).fill(value)
        user.page.keyboard.press("Tab")
    with user.page.expect_download() as download:
        user.page.get_by_role("button", name="Save as PNG").click()
    download.value.save_as(tmp_path / "picture.png")

    picture = np.asarray(Image.open(tmp_path / "picture.png").convert("RGB"))
    share, x, y = _green(picture)
    assert (download.value.suggested_filename, picture.shape) == ("t.png", (1520, 2000, 3))
    height = user.page.locator(VIEW_CANVAS).bounding_box()["height"] / PX_PER_M
    assert share == pytest.approx(0.4**2 / (height**2 * 2000 / 1520), rel=0.05)
    assert (x, y) == pytest.approx((0.5, 0.5), abs=0.01)
    assert user.sees_at((0.0, 0.0)), "the view has moved"


def test_a_video_of_the_view_is_saved(user: SceneUser, tmp_path: Path) -> None:
    """It is an MP4 with its index first, which plays while it loads; the view is dragged during the recording."""
    user.button("Record a video of the view").click()
    _wait_for_second(user, 1)
    _drag_view(user, 100, 0)
    _wait_for_second(user, 3)
    file = _stopped(user, tmp_path)

    frames = read_video(file)
    share, x, y = _green(frames[0].picture)
    height_px, width_px, _ = frames[0].picture.shape
    assert file.name == "t.mp4"
    assert file.read_bytes().index(b"moov") < file.read_bytes().index(b"mdat")
    assert (x, y) == pytest.approx((0.5, 0.5), abs=0.02)
    assert share * width_px * height_px == pytest.approx((0.4 * PX_PER_M) ** 2, rel=0.05)
    assert _green(frames[-1].picture)[1:] == pytest.approx((0.5 + 100 / width_px, 0.5), abs=0.02)
    assert frames[-1].time_s >= 2.5
    assert user.page.get_by_text("Recording the view").count() == 0


def test_without_webcodecs_mediarecorder_writes_the_video(user: SceneUser, tmp_path: Path) -> None:
    """This is the case on a page over plain http; a file that is not an MP4 has another suffix."""
    is_webm = "(type) => type.includes('webm')"
    user.page.evaluate(f"() => {{ delete window.VideoEncoder; MediaRecorder.isTypeSupported = {is_webm}; }}")
    _choose(user, "Record a video of the view")
    _wait_for_second(user, 2, ", as WebM")
    file = _stopped(user, tmp_path)

    _, x, y = _green(read_video(file)[-1].picture)
    assert file.name == "t.webm"
    assert (x, y) == pytest.approx((0.5, 0.5), abs=0.02)


def _wait_for_second(user: SceneUser, second: int, more: str = "") -> None:
    """Wait until the notice shows a second below ten, or a later one."""
    user.page.get_by_text(re.compile(rf"Recording the view (0:0[{second}-9]|0:[1-5]\d|[1-9]:\d\d){more}")).wait_for()


def _stopped(user: SceneUser, folder: Path) -> Path:
    """Stop the video; return its file."""
    with user.page.expect_download() as download:
        user.button("Stop and save").click()
    file = folder / download.value.suggested_filename
    download.value.save_as(file)
    return file


def test_a_link_shows_the_same_view(user: SceneUser, chromium: Any) -> None:
    _drag_view(user, 100, -50)
    user.until(lambda: user.sees_at((1.0, 0.5)) and not user.sees_at((0.0, 0.0)), what="for the square at its side")
    _choose(user, "Share")
    link = user.page.get_by_role("textbox", name="Link").input_value()

    other = SceneUser(chromium, link)
    other.until(lambda: other.sees_at((1.0, 0.5)), what="for the square at the same place")
    assert not other.sees_at((0.0, 0.0))
    other.close()
