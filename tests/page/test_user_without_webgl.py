"""A user whose browser has no WebGL sees the simulator's pictures, turns them, drives, and uses the panels."""

import io
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from tests.page.built_client import needs_client
from tests.page.panel_user import PATIENCE_MS, PanelUser
from tests.system.browser import running_page

from trundle.base.http.page_address import PageAddress
from trundle.page import PageServer, Session

pytestmark = [needs_client, pytest.mark.slow]
WORLD = """<sdf version="1.6"><world name="w">
<light name="sun" type="directional"><direction>-0.4 0.3 -0.9</direction><diffuse>0.9 0.9 0.9 1</diffuse></light>
<model name="floor"><static>1</static><link name="l"><visual name="v">
<geometry><box><size>9 9 0.1</size></box></geometry></visual></link></model>
<model name="pillar"><static>1</static><pose>-0.5 1.2 0.6 0 0 0</pose><link name="l"><visual name="v">
<geometry><box><size>0.3 0.3 1.2</size></box></geometry>
<material><ambient>0 0 0.8 1</ambient><diffuse>0 0 1 1</diffuse></material></visual></link></model>
<model name="trolley"><pose>0 0 0.3 0 0 0</pose><link name="base"><gravity>0</gravity><visual name="v">
<geometry><box><size>1.2 0.4 0.4</size></box></geometry>
<material><ambient>0.8 0 0 1</ambient><diffuse>1 0 0 1</diffuse></material></visual></link>
<plugin name="move" filename="libgazebo_ros_planar_move.so"/></model>
</world></sdf>"""
NO_WEBGL = """for (const kind of [HTMLCanvasElement, OffscreenCanvas]) {
    const get = kind.prototype.getContext;
    kind.prototype.getContext = function (name) { return name === "2d" ? get.apply(this, arguments) : null };
}"""
OVER_IT = ".panel, .float, .panes, .scene-overlay, header { visibility: hidden } .pictures { visibility: visible }"


class Onlooker(PanelUser):
    """Looks at the simulator's pictures."""

    def __init__(self, browser: Any, url: str, size: tuple[int, int]) -> None:
        self.size = size
        self.page = browser.new_page(viewport={"width": size[0], "height": size[1]})
        self.page.set_default_timeout(PATIENCE_MS)
        self.faults: list[str] = []
        self.page.on("pageerror", lambda error: self.faults.append(str(error)))
        self.page.on("response", self._check)
        self.page.add_init_script(NO_WEBGL)
        self.page.goto(url)
        self.page.get_by_label("Connected").first.wait_for()

    def _check(self, response: Any) -> None:
        if response.status >= 400:
            self.faults.append(f"{response.status} of {response.url}")

    def side_page(self, name: str) -> None:
        """Open a page of the left panel, or of the phone's sheet."""
        if self.size[0] > 640:
            self.page.get_by_role("tab", name=name).click()
        else:
            self.page.get_by_role("navigation").get_by_role("button", name=name).click()

    def picture(self) -> NDArray[np.int64]:
        """Return the shown picture without overlays."""
        style = self.page.add_style_tag(content=OVER_IT)
        png = self.page.screenshot()
        style.evaluate("style => style.remove()")
        return np.asarray(Image.open(io.BytesIO(png)).convert("RGB")).astype(np.int64)

    def shows_trolley(self) -> bool:
        red, green, blue = np.moveaxis(self.picture(), -1, 0)
        return bool((red - np.maximum(green, blue) > 60).mean() > 0.002)

    def column(self, channel: int) -> float:
        """Return the mean column of the red (0) or blue (2) pixels, by the width of the picture; NaN without any."""
        picture = self.picture()
        columns = np.nonzero(picture[..., channel] > 90 + picture[..., 2 - channel])[1]
        return float(columns.mean() / self.size[0]) if len(columns) else math.nan

    def newest_picture(self) -> NDArray[np.int64]:
        """Return a picture requested after this call."""
        for _ in range(2):  # the first may have been requested before
            with self.page.expect_response(lambda response: "camera.png" in response.url):
                pass
        self.until_still(lambda: self.picture().tobytes())
        return self.picture()

    def await_other_picture(self, than: NDArray[np.int64], why: str) -> NDArray[np.int64]:
        self.until(lambda: (np.abs(self.picture() - than).max(axis=-1) > 60).mean() > 0.002, what=f"for it {why}")
        return self.newest_picture()


@pytest.fixture(params=[(1440, 900), (390, 844)], ids=["desktop", "phone"])
def user(request: pytest.FixtureRequest, chromium: Any, tmp_path: Path) -> Iterator[Onlooker]:
    (tmp_path / "w.world").write_text(WORLD)
    with running_page("run", "w.world", "--port", "0", environment={"HOME": str(tmp_path)}, folder=tmp_path) as url:
        user = Onlooker(chromium, url, request.param)
        yield user
        user.close()


def test_pictures_are_shown_turned_and_the_robot_driven(user: Onlooker) -> None:
    user.page.get_by_text("This browser has no WebGL 2, so there is no 3D view.").wait_for()
    user.until(user.shows_trolley, what="for a picture of the trolley")
    assert user.page.get_by_role("toolbar", name="Tools").count() == 0, "they act on what is drawn"
    assert user.page.get_by_role("heading", name="Show").count() == 0, "nothing else can be shown"

    before = user.newest_picture()
    picture = user.page.locator("img.pictures")
    picture.focus()
    for _ in range(4):
        picture.press("ArrowRight")
    turned = user.await_other_picture(before, "to be seen from another side")
    x, y = 0.5 * user.size[0], 0.3 * user.size[1]  # not covered by anything
    user.page.mouse.move(x, y)
    user.page.mouse.down()
    user.page.mouse.move(x + 80, y, steps=4)
    user.page.mouse.up()
    before = user.await_other_picture(turned, "to be turned by a drag")

    user.page.locator(".disc").focus()  # the picture follows the trolley: the pillar moves by
    user.page.keyboard.down("w")
    user.page.wait_for_timeout(1000)
    user.page.keyboard.up("w")
    user.await_other_picture(before, "to have driven")
    assert user.shows_trolley()


def test_pictures_continue_after_a_failure_and_panels_work(user: Onlooker) -> None:
    user.until(user.shows_trolley, what="for a picture of the trolley")
    user.page.route("**/camera.png*", lambda route: route.abort())
    user.until(lambda: not user.shows_trolley(), what="for the picture to go")
    user.page.unroute("**/camera.png*")
    user.until(user.shows_trolley, what="for a picture to come again")
    if user.size[0] > 640:
        user.open("Topics")
        user.sees("/cmd_vel")
    else:
        user.page.get_by_role("navigation").get_by_role("button", name="World").click()
    trolley = user.page.get_by_role("treeitem").filter(has_text="trolley").first
    trolley.wait_for()
    assert trolley.get_by_role("button").count() == 0, "its eye acts on what is drawn"
    trolley.click(button="right")
    user.page.get_by_role("menuitem", name="Delete").wait_for()
    for name in ("Move to", "Follow", "Hide"):
        assert user.page.get_by_role("menuitem", name=name).count() == 0, "they act on what is drawn"
    user.page.keyboard.press("Escape")


def test_commands_of_the_3d_view_are_not_offered(user: Onlooker) -> None:
    user.page.keyboard.press("Control+k")
    search = user.page.get_by_role("dialog").get_by_role("combobox")
    options = user.page.get_by_role("listbox", name="Commands").get_by_role("option")
    for words, count in [
        ("Play or pause", 1),
        ("Show or hide the cameras", 1),
        ("Frame the selection", 0),
        ("Look from top", 0),
        ("Show or hide collisions", 0),
        ("Two views, stacked", 0),
        ("Measure", 0),
    ]:
        search.fill(words)
        user.until(lambda count=count: options.count() == count, what=f"for {count} of {words!r} in the palette")


def test_the_next_picture_is_requested_after_the_last_has_arrived(user: Onlooker) -> None:
    user.until(user.shows_trolley, what="for a picture of the trolley")
    routes: list[Any] = []
    user.page.route("**/camera.png*", lambda route: routes.append(route))
    user.until(lambda: len(routes) == 1, what="for the request for a picture")
    user.page.wait_for_timeout(2000)  # time for four requests
    assert len(routes) == 1
    routes[0].continue_()
    user.until(lambda: len(routes) == 2, what="for the next one")
    routes[1].continue_()
    user.page.unroute("**/camera.png*")


def test_the_notice_is_closed_for_good(user: Onlooker) -> None:
    notice = user.page.get_by_text("This browser has no WebGL 2")
    notice.wait_for()
    user.page.get_by_role("status").filter(has=notice).get_by_label("Dismiss").click()
    notice.wait_for(state="detached")
    user.until(user.shows_trolley, what="for a picture of the trolley")
    user.page.reload()
    user.page.get_by_label("Connected").first.wait_for()
    user.until(user.shows_trolley, what="for a picture of the trolley")
    assert notice.count() == 0


def test_the_edited_model_is_in_the_picture(user: Onlooker) -> None:
    """It comes to where the robot is before."""
    user.until(user.shows_trolley, what="for a picture of the trolley")
    trolley = user.column(0)
    assert abs(user.column(2) - trolley) > 0.05
    user.side_page("World")
    user.page.get_by_role("treeitem").filter(has_text="pillar").first.click(button="right")
    user.page.get_by_role("menuitem", name="Edit model…").click()
    user.page.get_by_role("tree", name="Model").wait_for()
    user.until(lambda: abs(user.column(2) - trolley) < 0.05, what="for the pillar in place of the trolley")
    user.button("Leave the editor").click()
    user.until(lambda: abs(user.column(0) - trolley) < 0.05, what="for the trolley again")


def test_a_shape_is_inserted_at_a_typed_position(user: Onlooker) -> None:
    user.until(user.shows_trolley, what="for a picture of the trolley")
    if user.size[0] > 640:
        user.side_page("Insert")
    else:
        user.side_page("World")
        user.button("World's menu").click()
        user.page.get_by_role("menuitem", name="Open Insert").click()
    user.button("Insert sphere").click()
    place = user.page.get_by_role("region", name="Position of the sphere")
    place.get_by_text("There is no 3D view to click in").wait_for()
    for axis, value in (("x", "2.5"), ("y", "-1")):
        place.get_by_label(f"Position {axis} [m]").fill(value)
    user.page.keyboard.press("Tab")
    place.get_by_role("button", name="Insert", exact=True).click()
    place.wait_for(state="detached")
    user.side_page("World")
    user.page.get_by_role("treeitem", selected=True).filter(has_text="sphere").wait_for()
    user.side_page("Inspector" if user.size[0] <= 640 else "World")
    assert user.page.get_by_label("x [m]", exact=True).input_value() == "2.500"
    assert user.page.get_by_label("y [m]", exact=True).input_value() == "−1.000"


def test_a_ros_graph_asks_for_no_pictures(chromium: Any) -> None:
    with PageServer.start(Session(title="graph", kind="graph"), at=PageAddress(port=0)) as server:
        user = Onlooker(chromium, server.url, (1440, 900))
        user.page.get_by_text("This browser has no WebGL 2").wait_for()
        requested: list[str] = []
        user.page.on("request", lambda request: requested.append(request.url))
        user.open("Topics")
        user.sees("There are no topics.")
        user.page.wait_for_timeout(1500)  # time for two pictures
        assert [url for url in requested if "camera.png" in url] == []
        assert server.requests() == []
        user.close()
