"""Services of a run's nodes answer while it is paused and while its timeline shows the past."""

import json
from collections.abc import Iterator
from typing import Any

import pytest
from tests.graphs import Graph, running_graph
from tests.page_client import ProtocolClient
from tests.system.browser import running_page

WORLD = """<sdf version="1.6"><world name="yard"><model name="mast"><link name="l"/>
<plugin name="imu" filename="libhector_gazebo_ros_imu.so"><topicName>imu</topicName></plugin></model></world></sdf>"""
NS = 1_000_000_000


class Operator(ProtocolClient):
    """Controls the run over the page's protocol."""

    def do(self, request: str, **fields: Any) -> None:
        number = next(self._numbers)
        self.send("trundle/request", id=number, request=request, **fields)
        self.until(lambda: any(message.get("id") == number and message["ok"] for message in self.jsons))

    def until_state(self, **expected: Any) -> None:
        self.until(lambda: self.state.items() >= expected.items())

    @property
    def state(self) -> dict[str, Any]:
        payloads = self.payloads("trundle/state")
        return json.loads(payloads[-1]) if payloads else {}


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


@pytest.fixture(scope="module")
def operator(graph: Graph, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Operator]:
    folder = tmp_path_factory.mktemp("yard")
    (folder / "yard.sdf").write_text(WORLD)
    words = ("run", "yard.sdf", "--port", "0", "--no-browser", "--pause")
    environment = {"ROS_MASTER_URI": graph.core.uri, "HOME": str(folder)}
    with running_page(*words, environment=environment, folder=folder) as url, Operator(url) as operator:
        operator.subscribe("trundle/state")
        yield operator


def test_services_answer_while_paused(graph: Graph, operator: Operator) -> None:
    operator.until_state(paused=True)
    node = graph.node("caller")

    loggers = graph.loop.run(node.call_service("/trundle/get_loggers", "roscpp/GetLoggers"))
    graph.loop.run(node.call_service("/imu/calibrate", "std_srvs/Empty"))

    assert loggers.loggers
    assert operator.state["time_ns"] == 0


def test_services_answer_in_the_past_and_logger_levels_keep_what_came_later(graph: Graph, operator: Operator) -> None:
    operator.do("run_to", time_ns=3 * NS)
    operator.until_state(time_ns=3 * NS)
    operator.do("seek", time_ns=NS)
    operator.until_state(time_ns=NS)
    node = graph.node("historian")

    graph.loop.run(node.call_service("/trundle/get_loggers", "roscpp/GetLoggers"))
    assert operator.state["timeline"]["end_ns"] == 3 * NS
    graph.loop.run(node.call_service("/imu/calibrate", "std_srvs/Empty"))  # as an edit there: a new future begins
    operator.until(lambda: operator.state["timeline"]["end_ns"] == NS)
