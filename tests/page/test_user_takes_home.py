"""A person takes home what the view shows: a picture, a video, a link."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from tests.graphs import Graph, running_graph
from tests.page.scene_user import PX_PER_M, VIEW_CANVAS, SceneUser, rviz_text

from trundle.page import GraphAddress, PageServer, Session
from trundle.page.client_files import CLIENT
from trundle.page.session import RvizFile
from trundle.page_address import PageAddress

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not (CLIENT / "index.html").exists(), reason="the page's client is not built: make"),
]

SQUARE = {"Class": "rviz/Marker", "Name": "Cube", "Enabled": True, "Marker Topic": "/square"}
GREEN = (0, 255, 0)


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


@pytest.fixture(scope="module")
def url(graph: Graph) -> Iterator[str]:
    """A page that shows a green square of 0.4 m in the middle."""
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


def _green(picture: NDArray[np.uint8]) -> tuple[float, float, float]:
    """Share of the picture that is green, and the middle of it as shares of width and height."""
    rows, columns = np.nonzero((np.abs(picture[:, :, :3].astype(int) - GREEN) < 100).all(axis=-1))
    height, width = picture.shape[:2]
    return len(rows) / (width * height), float(columns.mean() / width), float(rows.mean() / height)


def test_a_picture_of_any_size(user: SceneUser, tmp_path: Path) -> None:
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


def test_a_video_of_the_view(user: SceneUser, tmp_path: Path) -> None:
    av = pytest.importorskip("av", reason="av, which reads videos, is not installed: pip install av")
    _choose(user, "Record a video")
    note = user.page.get_by_text("Recording a video, 2 s")
    note.wait_for()
    with user.page.expect_download() as download:
        user.button("Stop and save").click()
    file = tmp_path / download.value.suggested_filename
    download.value.save_as(file)

    with av.open(str(file)) as video:
        pictures = [frame.to_ndarray(format="rgb24") for frame in video.decode(video=0)]
    share, x, y = _green(pictures[-1])
    assert file.name in ("t.mp4", "t.webm")
    assert len(pictures) >= 10
    assert share > 0
    assert (x, y) == pytest.approx((0.5, 0.5), abs=0.02)
    assert note.count() == 0


def test_a_link_shows_the_same_view(user: SceneUser, chromium: Any) -> None:
    x, y = user.at((0.5, 0.5))
    user.page.mouse.move(x, y)
    user.page.mouse.down(button="middle")
    user.page.mouse.move(x + 100, y - 50, steps=5)
    user.page.mouse.up(button="middle")
    user.until(lambda: user.sees_at((1.0, 0.5)) and not user.sees_at((0.0, 0.0)), what="for the square at its side")
    _choose(user, "Link to this view")
    link = user.page.get_by_role("textbox", name="Link").input_value()

    other = SceneUser(chromium, link)
    other.until(lambda: other.sees_at((1.0, 0.5)), what="for the square at the same place")
    assert not other.sees_at((0.0, 0.0))
    other.close()
