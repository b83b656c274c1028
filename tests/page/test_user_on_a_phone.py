"""A user drives and looks at panels on a phone of 390 × 844."""

import itertools
from collections.abc import Iterator
from typing import Any

import pytest
from tests.graphs import Graph, running_graph
from tests.page.built_client import needs_client
from tests.page.driving.test_driving import Robot
from tests.page.panel_user import PATIENCE_MS, PanelUser

from trundle.base.http.page_address import PageAddress
from trundle.page import ClockState, GraphAddress, PageServer, Session

pytestmark = [pytest.mark.slow, needs_client]

_BEHIND = """(on) => {
    for (const part of document.querySelectorAll("main, main *, .scene-overlay, .scene-overlay *"))
        part.style.background = on ? "magenta" : "";
}"""
_HEADINGS = """() => [...document.querySelectorAll(".sheet :is(thead tr, .loghead)")].map((row) => [...row.children]
    .filter((head) => head.checkVisibility({ visibilityProperty: true }))
    .map((head) => {
        const text = document.createRange();
        text.selectNodeContents(head);
        const { left, right } = text.getBoundingClientRect();
        return [head.textContent, left, right];
    }))"""
_GAP = 8
"""Smallest gap between two headings [px]."""


class PhoneUser(PanelUser):
    """Opens pages of the sheet."""

    def __init__(self, browser: Any, url: str, theme: str = "dark") -> None:
        context = browser.new_context(viewport={"width": 390, "height": 844}, color_scheme=theme, has_touch=True)
        self.page = context.new_page()
        self.page.set_default_timeout(PATIENCE_MS)
        self.faults: list[str] = []
        self.page.on("pageerror", self._note)
        self.page.goto(url)
        self.page.get_by_label("Connected").first.wait_for()

    def sheet(self, name: str) -> Any:
        """Open a page of the sheet; return the sheet once it has its height."""
        self.page.get_by_role("navigation").get_by_role("button", name=name, exact=True).click()
        sheet = self.page.locator(".sheet")
        self.until_still(sheet.bounding_box)
        return sheet

    def panel(self, name: str) -> None:
        """Open any panel in the sheet, by the palette."""
        self.button("More").click()
        self.page.get_by_role("menuitem", name="Search commands").click()
        self.page.get_by_role("combobox", name="Search commands").fill(f"Open {name}")
        self.page.get_by_role("option", name=f"Open {name}").wait_for()  # panels are loaded after the first picture
        self.page.keyboard.press("Enter")

    def close(self) -> None:
        self.page.context.close()
        assert self.faults == []


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


@pytest.fixture
def robot(graph: Graph) -> Iterator[Robot]:
    node = graph.node("robot")
    yield Robot(node, "/cmd_vel")
    graph.loop.run(node.shutdown())


@pytest.fixture(scope="module")
def url(graph: Graph) -> Iterator[str]:
    session = Session(title="turtlebot", kind="graph", drive_topic="/cmd_vel")
    node = graph.node("owner")
    address = GraphAddress(master_uri=graph.core.uri)
    with PageServer.start(session, at=PageAddress(port=0), graph=address, node=node) as page:
        yield page.url


@pytest.mark.parametrize("theme", ["dark", "light"])
def test_nothing_shows_through_the_sheet(chromium: Any, url: str, robot: Robot, theme: str) -> None:
    del robot  # the disc needs a listener
    user = PhoneUser(chromium, url, theme)
    user.page.locator(".disc").wait_for()
    box = user.sheet("Displays").bounding_box()
    below_corners = {**box, "y": box["y"] + 16, "height": box["height"] - 16}
    user.until_still(lambda: user.page.screenshot(clip=below_corners))
    plain = user.page.screenshot(clip=below_corners)
    before = user.page.screenshot()
    user.page.evaluate(_BEHIND, True)
    user.until(lambda: user.page.screenshot() != before, what="for the colors behind")
    assert user.page.screenshot(clip=below_corners) == plain
    user.close()


def test_a_drag_drives_above_a_half_open_sheet(chromium: Any, url: str, robot: Robot) -> None:
    user = PhoneUser(chromium, url)
    sheet = user.sheet("Displays")
    disc = user.page.locator(".disc").bounding_box()
    assert disc["y"] + disc["height"] <= sheet.bounding_box()["y"]
    x, y = disc["x"] + disc["width"] / 2, disc["y"] + disc["height"] / 2
    user.page.mouse.move(x, y)
    user.page.mouse.down()
    user.page.mouse.move(x, y - 60)
    user.until(lambda: any(linear > 0.4 for linear, _ in robot.velocities), what="for the robot to drive")
    user.page.mouse.up()
    user.until(lambda: robot.velocities[-1] == (0.0, 0.0), what="for the robot to stop")
    assert user.page.locator(".sheet.half").count() == 1
    user.close()


def test_the_menu_has_groups(chromium: Any, page: PageServer) -> None:
    user = PhoneUser(chromium, page.url)
    page.put_state(ClockState(time_ns=0, paused=False, real_time_factor=1.0, recording=None))
    user.button("More").click()
    menu = user.page.get_by_role("menu")
    record = menu.get_by_role("menuitem", name="Record", exact=True)
    user.until(lambda: record.count() == 1 or _reopen(user), what="for Record")
    groups = menu.evaluate(
        """(menu) => [...menu.children].reduce((groups, one) => {
            if (one.tagName === "HR") groups.push([]);
            else groups.at(-1).push(one.dataset.title);
            return groups;
        }, [[]])"""
    )
    firsts = ["Step 1", "Record", "Frame the selection", "Lessons"]
    assert [group[0] for group in groups] == firsts, groups
    menu.get_by_role("menuitem", name="Reset").click()
    user.page.get_by_role("menuitem", name="Reset poses only").wait_for()
    user.close()


def _reopen(user: PhoneUser) -> bool:
    user.page.keyboard.press("Escape")
    user.button("More").click()
    return False


@pytest.mark.parametrize("panel", ["Log", "Topics", "Nodes", "Services"])
def test_headings_stand_apart(chromium: Any, url: str, robot: Robot, panel: str) -> None:
    del robot
    user = PhoneUser(chromium, url)
    user.panel(panel)
    user.until(lambda: user.page.evaluate(_HEADINGS) != [], what="for the headings")
    (row,) = user.page.evaluate(_HEADINGS)
    assert len(row) >= 2
    gaps = [(one[0], other[0], other[1] - one[2]) for one, other in itertools.pairwise(row)]
    assert [gap for gap in gaps if gap[2] < _GAP] == []
    user.close()
