"""The built client in a real browser: start, connection, content policy, accessibility."""

import math
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.graphs import Graph, running_graph
from tests.page.built_client import needs_client

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, Session

ROOT = Path(__file__).parents[2]
AXE = ROOT / "web/node_modules/axe-core/axe.min.js"
TIMEOUT_MS = 60_000
LOOKS = [
    pytest.param(("dark", 1440, 900), id="dark"),
    pytest.param(("light", 1440, 900), id="light"),
    pytest.param(("dark", 390, 844), id="phone"),
]

pytestmark = [pytest.mark.browser, pytest.mark.slow, needs_client]


@pytest.fixture(scope="module", params=LOOKS)
def opened(request: pytest.FixtureRequest, chromium: Any, page: PageServer) -> Iterator[tuple[Any, list[str]]]:
    """The connected page in a browser, and the browser's errors."""
    theme, width, height = request.param
    context = chromium.new_context(viewport={"width": width, "height": height}, color_scheme=theme)
    tab = context.new_page()
    errors: list[str] = []
    tab.on("console", lambda message: message.type == "error" and errors.append(message.text))
    tab.on("pageerror", lambda error: errors.append(str(error)))
    tab.on("requestfailed", lambda failed: errors.append(f"{failed.url}: {failed.failure}"))
    tab.goto(page.url)
    tab.get_by_label("Connected").first.wait_for(timeout=TIMEOUT_MS)
    yield tab, errors
    context.close()


def test_the_page_connects_without_errors(opened: tuple[Any, list[str]]) -> None:
    """Errors include violations of the content security policy, which Chromium reports on its console."""
    tab, errors = opened
    tab.wait_for_timeout(500)

    assert errors == []
    assert tab.title() == "cart"


@pytest.mark.skipif(not AXE.is_file(), reason="axe-core is not installed in web/node_modules")
def test_axe_finds_nothing_serious(opened: tuple[Any, list[str]]) -> None:
    tab, _ = opened
    tab.evaluate(AXE.read_text())  # through the debugger, as the policy forbids inline scripts
    violations = tab.evaluate("axe.run().then((result) => result.violations)")

    serious = [violation for violation in violations if violation["impact"] in ("serious", "critical")]
    assert [f"{one['help']}: {node['html']}" for one in serious for node in one["nodes"]] == []


@pytest.fixture
def graph_tab(chromium: Any) -> Iterator[tuple[Any, Graph]]:
    """A page of a ROS graph with the Topics panel open, and the graph."""
    with running_graph() as graph:
        session = Session(title="t", kind="graph", fixed_frame="map", panels=("rqt_topic",))
        address = GraphAddress(master_uri=graph.core.uri)
        with PageServer.start(session, at=PageAddress(port=0), graph=address) as page:
            tab = chromium.new_page(viewport={"width": 1440, "height": 900})
            tab.goto(page.url)
            tab.get_by_label("Connected").first.wait_for(timeout=TIMEOUT_MS)
            yield tab, graph
            tab.close()


def test_topics_of_a_graph_are_decoded_and_measured(graph_tab: tuple[Any, Graph]) -> None:
    """TF goes through the worker into the tree of frames; the rate of /scan is about 20 Hz."""
    tab, graph = graph_tab
    node = graph.node("talker")
    tf, scan = node.advertise("/tf", "tf2_msgs/TFMessage"), node.advertise("/scan", "sensor_msgs/LaserScan")
    frames = tab.get_by_text("2 frames")
    rate = tab.get_by_role("row").filter(has_text="/scan").get_by_text(re.compile(r"^[1-9]\d*\.\d$"))
    for turn in range(600):
        pose = {"translation": {"x": math.sin(turn)}, "rotation": {"w": 1.0}}
        tf.publish({"transforms": [{"header": {"frame_id": "map"}, "child_frame_id": "base", "transform": pose}]})
        scan.publish({"header": {"frame_id": "base"}, "ranges": [1.0] * 360})
        tab.wait_for_timeout(50)
        if frames.count() == 1 and rate.count() == 1:
            break

    assert (frames.count(), rate.count()) == (1, 1)
