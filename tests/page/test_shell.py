"""The page's controls as a user operates them: driving, displays, the palette, the phone's sheet."""

import time
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from tests.graphs import Graph, running_graph
from tests.page.built_client import needs_client
from tests.page.driving.test_driving import Robot

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, RvizFile, SaveRviz, Session

TIMEOUT_MS = 60_000
RVIZ = """Visualization Manager:
  Displays:
    - {Class: rviz/Grid, Name: Floor, Enabled: true, Cell Size: 1}
    - {Class: jsk_rviz_plugins/OverlayText, Name: Planning, Enabled: true}
  Global Options: {Fixed Frame: map}
"""

_SMALL = """[...document.querySelectorAll("button:not(.grab)")]
    .filter((one) => one.offsetParent && one.getBoundingClientRect().height < 44).map((one) => one.outerHTML)"""
"""Script that lists targets of a phone that are too small to press; the sheet's handle has a larger hit area."""

pytestmark = [pytest.mark.browser, pytest.mark.slow, needs_client]


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


@pytest.fixture(scope="module")
def drive_page(graph: Graph) -> Iterator[PageServer]:
    session = Session(
        title="turtlebot",
        kind="graph",
        drive_topic="/cmd_vel",
        rviz=RvizFile(name="nav.rviz", text=RVIZ, writable=True),
    )
    node = graph.node("owner")
    address = GraphAddress(master_uri=graph.core.uri)
    with PageServer.start(session, at=PageAddress(port=0), graph=address, node=node) as page:
        yield page
    graph.loop.run(node.shutdown())


@pytest.fixture
def robot(graph: Graph) -> Iterator[Robot]:
    node = graph.node("robot")
    yield Robot(node, "/cmd_vel")
    graph.loop.run(node.shutdown())


Open = Callable[..., Any]


@pytest.fixture
def open_page(chromium: Any, drive_page: PageServer) -> Iterator[Open]:
    """Open the page and wait until it is connected."""
    contexts: list[Any] = []

    def opened(width: int = 1440, height: int = 900, **options: Any) -> Any:
        context = chromium.new_context(viewport={"width": width, "height": height}, color_scheme="dark", **options)
        contexts.append(context)
        tab = context.new_page()
        tab.set_default_timeout(TIMEOUT_MS)
        tab.goto(drive_page.url)
        tab.get_by_label("Connected").first.wait_for()
        if width > 640:
            tab.locator(".dv-tab").first.wait_for()  # the dock is loaded after the first picture
        return tab

    yield opened
    for context in contexts:
        context.close()


def _until(condition: Callable[[], object], tab: Any = None) -> None:
    end = time.monotonic() + 60
    while not condition():
        assert time.monotonic() < end
        if tab is None:
            time.sleep(0.01)
        else:
            tab.wait_for_timeout(10)


def test_holding_a_key_drives_and_releasing_it_stops(open_page: Open, robot: Robot) -> None:
    tab = open_page()
    tab.locator(".disc").wait_for()
    tab.keyboard.down("w")
    _until(lambda: robot.velocities.count((0.5, 0.0)) >= 3, tab)
    assert tab.get_by_text("Let go to stop").is_visible()
    tab.keyboard.up("w")
    _until(lambda: (0.0, 0.0) in robot.velocities, tab)
    tab.wait_for_timeout(500)

    assert robot.velocities.count((0.0, 0.0)) == 1
    assert robot.velocities[-1] == (0.0, 0.0)


def test_closing_the_tab_during_a_drag_of_the_disc_stops_the_robot(open_page: Open, robot: Robot) -> None:
    tab = open_page()
    box = tab.locator(".disc").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    tab.mouse.move(x, y)
    tab.mouse.down()
    tab.mouse.move(x - 100, y)
    _until(lambda: any(angular > 0.9 for _, angular in robot.velocities), tab)
    tab.close()
    _until(lambda: robot.velocities[-1] == (0.0, 0.0))
    time.sleep(0.5)

    assert robot.velocities[-2:] == [(0.0, 1.0), (0.0, 0.0)]


def test_keys_in_a_focused_field_do_not_drive(open_page: Open, robot: Robot) -> None:
    tab = open_page()
    tab.get_by_role("textbox", name="Largest speed").click()
    tab.keyboard.press("w")
    tab.wait_for_timeout(300)

    assert set(robot.velocities) <= {(0.0, 0.0)}  # the stop of an earlier drive may come late


def test_a_display_is_edited_undone_and_saved(open_page: Open, drive_page: PageServer) -> None:
    tab = open_page()
    row = tab.get_by_role("treeitem").filter(has_text="Floor").first
    row.click()
    tab.keyboard.press("ArrowRight")
    size = tab.get_by_label("Cell Size")
    size.fill("many")
    assert tab.locator(".fault").inner_text() == '"many" is not a number.'
    size.fill("2.5")
    size.press("Enter")
    tab.get_by_role("button", name="Save", exact=True).click()
    requests: list[Any] = []
    _until(lambda: requests.extend(drive_page.requests()) or requests, tab)
    drive_page.respond(requests[0].id)
    row.click()
    tab.keyboard.press("Control+z")
    _until(lambda: size.input_value() == "1", tab)

    assert isinstance(requests[0].action, SaveRviz)
    assert "Cell Size: 2.5" in requests[0].action.text
    assert "jsk_rviz_plugins/OverlayText" in requests[0].action.text  # unknown displays are kept
    assert tab.get_by_text("not supported").first.is_visible()


def test_the_palette_runs_commands_and_the_theme_is_remembered(open_page: Open) -> None:
    tab = open_page()
    theme = "document.documentElement.dataset.theme"
    assert tab.evaluate(theme) == "dark"
    tab.keyboard.press("Control+k")
    tab.keyboard.type("theme")
    tab.keyboard.press("Enter")
    tab.reload()
    tab.get_by_label("Connected").first.wait_for()

    assert tab.evaluate(theme) == "light"


def test_every_key_in_the_help_works(open_page: Open) -> None:
    tab = open_page()
    tab.keyboard.press("?")
    help_ = tab.get_by_role("dialog", name="Keys")
    for text in ("Frame the selection", "2D Nav Goal", "W A S D"):
        help_.get_by_text(text, exact=True).wait_for()
    tab.keyboard.press("Escape")
    help_.wait_for(state="detached")
    dock = ".dock:not(.shut)" if tab.locator(".dock.shut").count() else ".dock.shut"
    for key, part in (("[", "aside.left.rail"), ("]", "aside.right:not(.rail)"), ("\\", dock)):
        tab.keyboard.press(key)
        tab.locator(part).wait_for()
    tab.keyboard.press("g")
    tab.get_by_role("button", name="2D Nav Goal", pressed=True).wait_for()


def test_a_key_right_after_closing_a_dialog_reaches_the_page(open_page: Open) -> None:
    """Until the next frame, the focus may still be in the dialog."""
    tab = open_page()
    tab.keyboard.press("?")
    tab.get_by_role("dialog", name="Keys").wait_for()
    tab.evaluate("""() => {
        const dialog = document.querySelector("dialog");
        dialog.close();
        dialog.querySelector("button").dispatchEvent(new KeyboardEvent("keydown", { key: "[", bubbles: true }));
    }""")
    tab.locator("aside.left.rail").wait_for()


def _resting_box(tab: Any, selector: str) -> dict[str, float]:
    """Return the bounding box of an element once it no longer moves, as while the sheet closes."""
    box, before = tab.locator(selector).bounding_box(), None
    while box is None or box != before:
        tab.wait_for_timeout(300)
        box, before = tab.locator(selector).bounding_box(), box
    return box


def test_a_phone_drives_by_touch_and_opens_its_sheet(open_page: Open, robot: Robot) -> None:
    tab = open_page(390, 844, has_touch=True, is_mobile=True)
    tab.get_by_role("button", name="Displays").tap()
    tab.get_by_role("treeitem").filter(has_text="Floor").first.wait_for()
    assert tab.evaluate(_SMALL) == []
    tab.get_by_role("button", name="Displays").tap()
    assert tab.evaluate(_SMALL) == []
    box = _resting_box(tab, ".disc")
    at = {"x": box["x"] + box["width"] / 2, "y": box["y"] + 10}
    touch = tab.context.new_cdp_session(tab)
    touch.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [at]})
    _until(lambda: any(linear > 0.4 for linear, _ in robot.velocities), tab)
    touch.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    _until(lambda: robot.velocities[-1] == (0.0, 0.0), tab)
