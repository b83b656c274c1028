"""Panels that show a graph and talk to it: topics, services, parameters, the log, drawings."""

import time
from collections.abc import Iterator
from typing import Any

import pytest
from tests.graphs import PATIENCE_S, Graph, running_graph
from tests.page.built_client import needs_client
from tests.page.panel_user import PanelUser

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, Session
from trundle.ros import Node

pytestmark = needs_client


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


@pytest.fixture(scope="module")
def node(graph: Graph) -> Node:
    return graph.node("tester")


@pytest.fixture(scope="module")
def server(graph: Graph) -> Iterator[PageServer]:
    address = GraphAddress(master_uri=graph.core.uri)
    with PageServer.start(Session(title="t", kind="graph"), at=PageAddress(port=0), graph=address) as server:
        yield server


@pytest.fixture(scope="module")
def user(chromium: Any, server: PageServer) -> Iterator[PanelUser]:
    user = PanelUser(chromium, server.url)
    yield user
    user.close()


def test_topics_are_listed_with_their_rate_and_echoed(graph: Graph, node: Node, user: PanelUser) -> None:
    publisher = node.advertise("/speed", "geometry_msgs/Twist")
    user.open("Topics")
    row = user.page.locator("tr", has=user.button("/speed"))
    row.wait_for()
    rate = row.locator("td").nth(2)

    def is_measured() -> bool:
        publisher.publish({"linear": {"x": -0.25}})
        text = rate.inner_text()
        return text.replace(".", "").isdigit() and float(text) > 1.0

    user.until(is_measured, what="for a rate")
    user.button("/speed").click()
    echoed = user.page.get_by_role("treeitem", name="x −0.25 m/s")
    user.until(lambda: publisher.publish({"linear": {"x": -0.25}}) or echoed.count(), what="for the echo")
    user.button("Close").click()
    publisher.unregister()


@pytest.mark.slow
def test_a_form_publishes_once_and_periodically(graph: Graph, node: Node, user: PanelUser) -> None:
    received: list[Any] = []
    node.subscribe("/order", "geometry_msgs/PoseStamped", received.append)
    user.open("Topics")
    user.button("/order").click()
    user.page.locator(".toolrow").get_by_role("button", name="Publish", exact=True).click()
    user.type("pose.position.x", "1.5")
    user.page.get_by_role("button", name="header").click()
    user.type("header.frame_id", "map")
    user.type("header.stamp", "now")
    user.button("Publish once").click()
    graph.until(lambda: received)
    assert (received[0].pose.position.x, received[0].header.frame_id) == (1.5, "map")
    assert abs(received[0].header.stamp.sec - time.time()) < PATIENCE_S

    user.type("Rate [Hz]", "20")
    user.button("Publish at").click()
    graph.until(lambda: len(received) >= 5)
    user.button("Stop").click()
    user.until_still(lambda: len(received))
    user.button("Close").click()


@pytest.mark.slow
def test_a_form_calls_a_service(node: Node, user: PanelUser) -> None:
    def answer(request: Any) -> dict[str, object]:
        return {"success": request.data, "message": "lamp"}

    service = node.advertise_service("/lamp", "std_srvs/SetBool", answer)
    user.open("Services")
    user.button("/lamp").click()
    user.page.get_by_role("checkbox", name="data").check()
    user.button("Call").click()
    user.page.get_by_role("treeitem", name="success true").wait_for()
    user.page.get_by_role("treeitem", name="message lamp").wait_for()
    user.button("Close").click()
    service.unregister()


@pytest.mark.slow
def test_a_failed_service_call_shows_its_reason(node: Node, user: PanelUser) -> None:
    def fail(_request: Any) -> dict[str, object]:
        raise RuntimeError("the lamp is broken")

    service = node.advertise_service("/broken", "std_srvs/Empty", fail)
    user.open("Services")
    user.button("/broken").click()
    user.button("Call").click()
    user.page.get_by_role("alert").get_by_text("broken").wait_for()
    user.button("Close").click()
    service.unregister()


@pytest.mark.slow
def test_a_parameter_is_edited_with_its_type_and_undone(graph: Graph, node: Node, user: PanelUser) -> None:
    def value() -> object:
        return graph.loop.run(node.params.get("/base/rate"))

    graph.loop.run(node.params.set("/base/rate", 10.0))
    user.open("Parameters")
    user.type("/base/rate", "12")
    graph.until(lambda: value() == 12.0)
    assert isinstance(value(), float)
    user.page.keyboard.press("Escape")
    user.page.keyboard.press("Control+z")
    graph.until(lambda: value() == 10.0)


@pytest.mark.slow
def test_the_log_shows_levels_and_sources(graph: Graph, node: Node, user: PanelUser) -> None:
    publisher = node.advertise("/rosout", "rosgraph_msgs/Log")
    user.open("Log")
    graph.until(lambda: publisher.has_subscribers)
    fields = {"name": "/tester", "file": "src/wheel.cpp", "line": 42, "function": "spin"}
    publisher.publish(fields | {"level": 2, "msg": "all is well"})
    publisher.publish(fields | {"level": 8, "msg": "a wheel is lost"})
    user.sees("all is well")
    user.page.get_by_role("button", name="Info").click()
    user.page.get_by_text("all is well").wait_for(state="detached")
    user.sees("a wheel is lost")
    user.page.get_by_text("a wheel is lost").first.click()
    user.sees("src/wheel.cpp:42")
    user.button("Close").click()

    publisher.publish(fields | {"level": 4, "name": "/other", "msg": "a wheel squeaks"})
    user.sees("a wheel squeaks")
    user.button("Filter").click()
    user.page.get_by_label("Filter by node").fill("other")
    user.page.get_by_text("a wheel is lost").wait_for(state="detached")
    user.page.get_by_label("Filter by node").fill("")
    user.page.get_by_label("Filter by text, or /expression/").fill("/is l.st$/")
    user.page.get_by_text("a wheel squeaks").wait_for(state="detached")
    user.sees("a wheel is lost")
    user.button("Filter").click()
    user.sees("a wheel squeaks")


@pytest.mark.slow
def test_nodes_and_the_graph_are_drawn(graph: Graph, node: Node, user: PanelUser) -> None:
    command = graph.node("rostopic_4711")  # as `rostopic pub` names itself
    command.advertise("/chain", "std_msgs/String")
    listener = graph.node("listener")
    listener.subscribe("/chain", "std_msgs/String", lambda _message: None)
    user.open("Graph")
    drawing = user.page.get_by_role("group", name="Graph of nodes and topics")
    drawing.get_by_role("img", name="topic /chain: 1 in, 1 out").wait_for()
    drawing.get_by_role("img", name="node /rostopic_4711: 0 in, 1 out").wait_for()
    assert int(user.page.get_by_text(" hidden", exact=False).inner_text().split()[0]) >= 2  # /rosout and this page
    with user.page.expect_download() as download:
        user.button("SVG").click()
    text = download.value.path().read_text()
    assert "/listener" in text
    assert "var(" not in text
    user.open("Nodes")
    user.button("/listener").click()
    user.page.get_by_role("region", name="Subscriptions").get_by_text("/chain").wait_for()
    user.button("Close").click()
    graph.loop.run(listener.shutdown())
    graph.loop.run(command.shutdown())


@pytest.mark.slow
def test_tf_frames_are_shown_as_a_tree(graph: Graph, node: Node, user: PanelUser) -> None:
    publisher = node.advertise("/tf_static", "tf2_msgs/TFMessage", latch=True)
    transform = {"header": {"frame_id": "base_link"}, "child_frame_id": "laser", "transform": {"rotation": {"w": 1.0}}}
    publisher.publish({"transforms": [transform]})
    user.open("TF tree")
    user.page.get_by_role("img", name="laser in base_link: static").wait_for()
    publisher.unregister()
