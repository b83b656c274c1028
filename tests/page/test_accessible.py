"""Axe finds nothing on any page of a ROS graph, in any of its states."""

from collections.abc import Iterator
from typing import Any

import pytest
from tests.graphs import Graph, running_graph
from tests.page.axe import assert_accessible, load_axe, needs_axe
from tests.page.built_client import needs_client
from tests.page.panel_user import PanelUser
from tests.page.scene_user import rviz_text

from trundle.base.http.page_address import PageAddress
from trundle.page import TERMINAL, GraphAddress, JointSlider, NodeTerminal, PageServer, RvizFile, Session

PANELS = ("Plots", "Topics", "Log", "Graph", "Timeline", "Nodes", "Parameters", "Services", "TF tree", "Images")
CONTROLS = ("Reconfigure", "Joints", "Steering", "Joystick", "Terminal")
SIDES = ("World", "Displays", "Inspector", "Views", "Tool properties")
RVIZ = rviz_text(
    {"Class": "rviz/LaserScan", "Name": "Scan", "Enabled": True, "Topic": "/scan"},
    {"Class": "rviz/Group", "Name": "Group", "Enabled": True, "Displays": [{"Class": "rviz/Grid", "Enabled": True}]},
    {"Class": "jsk_rviz_plugins/OverlayText", "Name": "Planning", "Enabled": True},
)

pytestmark = [pytest.mark.slow, needs_client, needs_axe]


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        node = graph.node("robot")
        node.subscribe("/cmd_vel", "geometry_msgs/Twist", lambda _message: None)
        node.advertise("/scan", "sensor_msgs/LaserScan")
        node.advertise("/image", "sensor_msgs/Image")
        graph.ready(node)
        yield graph


@pytest.fixture(scope="module")
def server(graph: Graph) -> Iterator[PageServer]:
    session = Session(
        title="t",
        kind="graph",
        rviz=RvizFile(name="t.rviz", text=RVIZ, writable=True),
        images=("/image",),
        sliders=(JointSlider(name="arm", lower=-1.0, upper=1.0, position=0.5),),
        joystick=True,
        terminals=(NodeTerminal(name="/drive"), NodeTerminal(name="/watch", ended="/watch has died")),
    )
    address = GraphAddress(master_uri=graph.core.uri)
    with PageServer.start(session, at=PageAddress(port=0), graph=address, node=graph.node("owner")) as server:
        server.put_terminal(f"{TERMINAL}0", 0, (80, 24), b"i: \x1b[31mforward\x1b[0m")
        yield server


@pytest.fixture(params=["dark", "light"])
def user(request: pytest.FixtureRequest, chromium: Any, server: PageServer) -> Iterator[PanelUser]:
    user = PanelUser(chromium, server.url)
    if user.page.evaluate("document.documentElement.dataset.theme") != request.param:
        user.page.get_by_role("button", name=f"{request.param.capitalize()} theme").click()
    load_axe(user.page)
    yield user
    user.close()


def _dialog(user: PanelUser, keys: str, name: str) -> None:
    user.page.keyboard.press(keys)
    user.page.get_by_role("dialog", name=name).wait_for()
    assert_accessible(user.page, name)
    user.page.keyboard.press("Escape")


def test_panels_sides_and_dialogs(user: PanelUser) -> None:
    for panel in (*PANELS, *CONTROLS):
        user.open(panel)
        if panel == "Terminal":
            user.sees("forward")
        assert_accessible(user.page, panel)
    for side in SIDES:
        tab = user.page.get_by_role("tab", name=side)
        (tab if tab.count() else user.page.locator(".rail").get_by_role("button", name=side)).first.click()
        assert_accessible(user.page, side)
    user.button("Lessons").click()
    user.page.get_by_role("button", name="A robot in SDF").click()
    for step in ("Step 2: Drive it", "Step 6: The model's files"):
        user.button(step).click()
        user.page.get_by_role("list", name="Checks").wait_for()
        assert_accessible(user.page, step)
    user.button("Close the lesson").click()
    user.page.get_by_role("tab", name="Displays").click()
    user.button("Add").click()
    user.page.get_by_role("treeitem").filter(has_text="Scan").first.press("ArrowRight")
    assert_accessible(user.page, "a display that is open, what can be added")
    user.page.get_by_label("Size (m)").fill("wide")
    assert_accessible(user.page, "a field that is wrong")
    user.page.keyboard.press("Escape")
    user.page.get_by_role("button", name="Enlarge image", exact=True).first.click()
    assert_accessible(user.page, "an enlarged picture")
    _dialog(user, "Control+k", "Search commands")
    user.page.locator("canvas[aria-label='3D view']").focus()
    _dialog(user, "?", "Keys")
    user.button("Details").click()
    assert_accessible(user.page, "the list of what is missing")


def test_the_sheet_of_a_phone_and_a_lost_connection(chromium: Any, server: PageServer) -> None:
    """Must be last, as it ends the server."""
    tab = chromium.new_page(viewport={"width": 390, "height": 844})
    tab.goto(server.url)
    tab.get_by_label("Connected").first.wait_for()
    load_axe(tab)
    for page in ("World", "Displays", "Inspector", "Plots", "Log"):
        tab.get_by_role("navigation").get_by_role("button", name=page, exact=True).click()
        assert_accessible(tab, f"{page} on a phone")
    tab.get_by_role("button", name="More", exact=True).click()
    tab.get_by_role("menuitem", name="Lessons").click()
    tab.get_by_role("button", name="A car with roslaunch").click()
    tab.get_by_role("button", name="Next", exact=True).click()
    tab.get_by_role("list", name="Checks").wait_for()
    assert_accessible(tab, "a lesson on a phone")
    server.close()
    tab.get_by_label("Connection lost").first.wait_for()
    assert_accessible(tab, "a lost connection")
    tab.close()
