"""A user sees the robot: at one distance however the page loads, and told about where it is hidden or gone."""

import itertools
import re
from collections.abc import Iterator
from typing import Any

import pytest
from tests.page.built_client import needs_client
from tests.page.panel_user import PATIENCE_MS
from tests.page_client import ProtocolClient
from tests.system.browser import running_page

pytestmark = [pytest.mark.slow, needs_client]

LATE_FILES = {"nothing": None, "the world": r"\.glb", "the dock": r"/(panels|dock)-.*\.js"}
LEFT, COVERED = "rp2w has left the view", "rp2w is behind the controls"


@pytest.fixture(scope="module")
def url() -> Iterator[str]:
    with running_page("run", "rp2w_at_home.world", "--pause", "--port", "0", environment={}) as url:
        yield url


def _wait_for_the_scene(tab: Any) -> None:
    """Wait until everything has come, and the camera rests."""
    tab.get_by_label("Connected").first.wait_for()
    tab.locator(".disc").wait_for()
    tab.locator(".tile:visible").first.wait_for()
    if tab.viewport_size["width"] > 640:
        tab.locator(".dock:not(.shut) .dv-tab").first.wait_for()
    tab.get_by_role("progressbar", name="Loading the world").wait_for(state="detached")
    pictures = [b""]
    for _ in range(60):
        pictures.append(tab.screenshot())
        if pictures[-1] == pictures[-2]:
            return
        tab.wait_for_timeout(1500)
    raise AssertionError("the scene does not come to rest")


def _distance(browser: Any, url: str, late: str | None) -> float:
    """Return the camera's distance [m] of a page that has loaded, with some of its files last."""
    context = browser.new_context(viewport={"width": 1440, "height": 900})
    tab = context.new_page()
    tab.set_default_timeout(PATIENCE_MS)
    held: list[Any] = []
    is_late = [True]
    if late is not None:
        tab.route(re.compile(late), lambda route: held.append(route) if is_late[0] else route.continue_())
    tab.goto(url)
    tab.locator(".disc").wait_for()
    tab.wait_for_timeout(3000)  # all else has come
    if late is not None:
        assert held
        is_late[0] = False
        for route in held:
            route.continue_()
    _wait_for_the_scene(tab)
    tab.get_by_role("tab", name="Views").click()
    value = tab.locator('aside input[aria-label="Distance [m]"]').input_value()
    context.close()
    return float(value)


def test_the_robot_is_framed_at_one_distance_whatever_comes_last(chromium: Any, url: str) -> None:
    distances = {name: _distance(chromium, url, late) for name, late in LATE_FILES.items()}
    assert all(one == pytest.approx(distances["nothing"], rel=0.02) for one in distances.values()), distances


class Mover(ProtocolClient):
    """Moves the robot of a paused world."""

    def __init__(self, url: str) -> None:
        super().__init__(url)
        self._numbers = itertools.count(1)

    def put(self, x: float, y: float) -> None:
        number = next(self._numbers)
        fields = {"model": "rp2w", "link": "chassis", "position": [x, y, 0.089], "orientation": [1, 0, 0, 0]}
        self.send("trundle/request", id=number, request="pose", **fields)
        self.until(lambda: any(one.get("id") == number and one["ok"] for one in self.jsons))


AWAY = (0.4975, -0.8674)
"""Direction on the ground from the robot to the first camera."""
LEFT_OF_IT = (-0.8674, -0.4975)


def _spot(nearer: float, left: float = 0.0) -> tuple[float, float]:
    """Return a point of the ground that is nearer to the first camera than the robot's place, and left of it [m]."""
    return nearer * AWAY[0] + left * LEFT_OF_IT[0], 0.203 + nearer * AWAY[1] + left * LEFT_OF_IT[1]


SPOTS = {(720, 900): _spot(2.6, 0.27), (390, 844): _spot(1.5)}
"""Where the robot is seen below the free part of the picture: between disc and tiles, or above the disc."""


@pytest.mark.parametrize(("width", "height"), [(720, 900), (390, 844)])
def test_a_robot_that_is_hidden_or_gone_is_told_until_it_is_seen(
    chromium: Any, url: str, width: int, height: int
) -> None:
    context = chromium.new_context(viewport={"width": width, "height": height}, has_touch=width < 641)
    tab = context.new_page()
    tab.set_default_timeout(PATIENCE_MS)
    with Mover(url) as mover:
        mover.put(*_spot(0.0))
        tab.goto(url)
        _wait_for_the_scene(tab)
        told = tab.locator(".notice .said").filter(has_text="rp2w")
        assert told.count() == 0
        mover.put(*_spot(2.5))
        told.get_by_text(COVERED).wait_for()
        mover.put(*_spot(7.0))
        told.get_by_text(LEFT).wait_for()
        mover.put(*SPOTS[width, height])
        told.wait_for(state="detached")
        mover.put(*_spot(7.0))
        told.get_by_text(LEFT).wait_for()
        mover.put(*_spot(0.0))
        told.wait_for(state="detached")
        mover.put(*_spot(2.5))
        told.get_by_text(COVERED).wait_for()
        tab.get_by_role("button", name="Follow", exact=True).click()
        told.wait_for(state="detached")
    context.close()


@pytest.mark.parametrize(("width", "height"), [(720, 900), (390, 844)])
def test_the_view_follows_a_robot_that_is_driven_behind_the_controls(
    chromium: Any, url: str, width: int, height: int
) -> None:
    """The hand on the disc cannot press a button."""
    context = chromium.new_context(viewport={"width": width, "height": height})
    tab = context.new_page()
    tab.set_default_timeout(PATIENCE_MS)
    with Mover(url) as mover:
        mover.put(*_spot(0.0))
        tab.goto(url)
        _wait_for_the_scene(tab)
        box = tab.locator(".disc").bounding_box()
        tab.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        tab.mouse.down()
        tab.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2 - 20)
        tab.locator(".disc .ring:not(.rest)").wait_for()
        sofa = {"x": width * 0.6, "y": height * 0.3, "width": 80, "height": 60}
        before = tab.screenshot(clip=sofa)
        mover.put(*_spot(2.5))
        for _ in range(120):
            if tab.screenshot(clip=sofa) != before:
                break
            tab.wait_for_timeout(500)
        else:
            raise AssertionError("the camera stays")
        tab.mouse.up()
        mover.put(*_spot(7.0))
        _wait_for_the_scene(tab)
        assert tab.locator(".notice .said").filter(has_text="rp2w").count() == 0
        mover.put(*_spot(0.0))
    context.close()
