"""The page's own parts as a person uses them: driving, displays, the palette, the phone's sheet."""

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
    - {Class: moveit_rviz_plugin/MotionPlanning, Name: Planning, Enabled: true}
  Global Options: {Fixed Frame: map}
"""

_SMALL = """[...document.querySelectorAll("button:not(.grab)")]
    .filter((one) => one.offsetParent && one.getBoundingClientRect().height < 44).map((one) => one.outerHTML)"""
"""Targets of a phone that are too small to press; the sheet's handle reaches beyond its own box."""

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
            tab.locator(".dv-tab").first.wait_for()  # the dock comes after the first picture
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


def test_a_held_key_drives_and_letting_go_stops(open_page: Open, robot: Robot) -> None:
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


def test_a_tab_that_closes_while_the_disc_is_dragged_stops_the_robot(open_page: Open, robot: Robot) -> None:
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


def test_a_field_with_the_focus_takes_the_keys(open_page: Open, robot: Robot) -> None:
    tab = open_page()
    tab.get_by_role("textbox", name="Greatest speed").click()
    tab.keyboard.press("w")
    tab.wait_for_timeout(300)

    assert set(robot.velocities) <= {(0.0, 0.0)}  # the stop of a drive before may come late


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
    taken: list[Any] = []
    _until(lambda: taken.extend(drive_page.requests()) or taken, tab)
    drive_page.respond(taken[0].id)
    row.click()
    tab.keyboard.press("Control+z")
    _until(lambda: size.input_value() == "1", tab)

    assert isinstance(taken[0].action, SaveRviz)
    assert "Cell Size: 2.5" in taken[0].action.text
    assert "moveit_rviz_plugin/MotionPlanning" in taken[0].action.text  # what is not understood is kept
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


def test_the_help_names_the_keys_and_each_does_what_it_says(open_page: Open) -> None:
    tab = open_page()
    tab.keyboard.press("?")
    help_ = tab.get_by_role("dialog", name="Keys")
    for text in ("Frame what is selected", "2D Nav Goal", "W A S D"):
        help_.get_by_text(text, exact=True).wait_for()
    tab.keyboard.press("Escape")
    help_.wait_for(state="detached")
    for key, part in (("[", "aside.left.rail"), ("]", "aside.right:not(.rail)"), ("\\", ".dock.shut")):
        tab.keyboard.press(key)
        tab.locator(part).wait_for()
    tab.keyboard.press("g")
    tab.get_by_role("button", name="2D Nav Goal", pressed=True).wait_for()


def test_a_key_right_after_a_dialog_closed_is_the_pages(open_page: Open) -> None:
    """Until the next frame the focus may still be inside of the dialog."""
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
    """Box of an element once it no longer moves, as it does while the sheet closes."""
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
