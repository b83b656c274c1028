"""A program of rqt that starts while the page is open opens its panel, even one that the user has closed."""

from collections.abc import Iterator
from typing import Any

import pytest
from tests.graphs import running_graph
from tests.page.built_client import needs_client
from tests.page.panel_user import PanelUser

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, Session

pytestmark = [pytest.mark.slow, needs_client]

PANELS = {
    "rqt_bag": "Timeline",
    "rqt_graph": "Graph",
    "rqt_console": "Log",
    "rqt_topic": "Topics",
    "rqt_plot": "Plots",
    "rqt_image_view": "Images",
    "rqt_reconfigure": "Reconfigure",
    "rqt_robot_steering": "Steering",
    "rqt_tf_tree": "TF tree",
    "rqt_publisher": "Topics",
    "rqt_service_caller": "Services",
    "joint_state_publisher_gui": "Joints",
    "joy": "Joystick",
    "xterm": "Terminal",
}


@pytest.fixture(scope="module")
def server() -> Iterator[PageServer]:
    with running_graph() as graph:
        address = GraphAddress(master_uri=graph.core.uri)
        with PageServer.start(Session(title="t", kind="graph"), at=PageAddress(port=0), graph=address) as server:
            yield server


@pytest.fixture(scope="module")
def user(chromium: Any, server: PageServer) -> Iterator[PanelUser]:
    user = PanelUser(chromium, server.url)
    yield user
    user.close()


@pytest.mark.parametrize("program", PANELS)
def test_starting_a_program_opens_its_panel(server: PageServer, user: PanelUser, program: str) -> None:
    panel = user.page.locator(".dv-tab", has_text=PANELS[program])
    if panel.count():
        panel.focus()
        user.page.keyboard.press("Delete")
        panel.wait_for(state="detached")
    started = tuple(PANELS)[: tuple(PANELS).index(program) + 1]
    server.set_session(Session(title="t", kind="graph", panels=started))

    user.page.locator(".dv-active-tab", has_text=PANELS[program]).wait_for()
