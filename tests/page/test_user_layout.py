"""A user arranges the page: open panels and their widths are remembered; the view can be frozen."""

from collections.abc import Iterator
from typing import Any

import pytest
from tests.graphs import Graph, running_graph
from tests.page.built_client import needs_client
from tests.page.scene_user import SceneUser, rviz_text

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, Session
from trundle.page.session import RvizFile

pytestmark = [pytest.mark.slow, needs_client]

SQUARE = {"Class": "rviz/Marker", "Name": "Cube", "Enabled": True, "Marker Topic": "/square"}
FREEZE = "Freeze view"


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


@pytest.fixture
def user(chromium: Any, graph: Graph) -> Iterator[SceneUser]:
    session = Session(title="t", kind="graph", rviz=RvizFile(name="t.rviz", text=rviz_text(SQUARE), writable=False))
    with PageServer.start(session, at=PageAddress(port=0), graph=GraphAddress(master_uri=graph.core.uri)) as server:
        user = SceneUser(chromium, server.url)
        yield user
        user.close()


def test_a_frozen_view_is_still_and_then_shows_the_newest_data(user: SceneUser, graph: Graph) -> None:
    square = graph.node("square").advertise("/square", "visualization_msgs/Marker", latch=True)

    def show_at(x: float) -> None:
        message: dict[str, Any] = {"type": 1, "header": {"frame_id": "map"}}
        message |= {"scale": {"x": 0.4, "y": 0.4, "z": 0.4}, "color": {"g": 1.0, "a": 1.0}}
        square.publish(message | {"pose": {"position": {"x": x}, "orientation": {"w": 1.0}}})

    show_at(0.0)
    user.until(lambda: user.sees_at((0.0, 0.0)), what="for the square")
    user.button(FREEZE).click()
    user.open("Topics")
    for x in (1.0, -1.0):
        show_at(x)
    user.page.wait_for_timeout(1000)

    assert user.sees_at((0.0, 0.0)), "the frozen view has changed"
    user.button(FREEZE).click()
    user.until(lambda: user.sees_at((-1.0, 0.0)), what="for the newest")
    assert not user.sees_at((0.0, 0.0))


def test_the_layout_is_restored_when_the_page_is_reloaded(user: SceneUser) -> None:
    def edges() -> list[float]:
        style = "getComputedStyle(document.documentElement)"
        return [user.page.evaluate(f"parseFloat({style}.getPropertyValue('--in-{edge}'))") for edge in "lrb"]

    first = edges()
    left = user.page.get_by_role("separator").first
    box = left.bounding_box()
    user.page.mouse.move(box["x"] + box["width"] / 2, box["y"] + 100)
    user.page.mouse.down()
    user.page.mouse.move(box["x"] - 25, box["y"] + 100, steps=5)
    user.page.mouse.up()
    user.button("Open the dock").click()
    arranged = edges()
    user.page.reload()
    user.page.get_by_label("Connected").first.wait_for()

    assert arranged[0] < first[0] - 10
    assert arranged[2] > first[2] + 80
    user.until(lambda: edges() == arranged, what="for the former layout")
