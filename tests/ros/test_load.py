"""Many topics, subscribers and short connections; `python -m bench.load` does the same for ten minutes."""

import socket
from pathlib import Path
from typing import Any

import pytest
from bench.load import run_load
from tests.ros.conftest import PATIENCE_S

from trundle.ros import MasterProxy, blocking_call

pytestmark = pytest.mark.slow


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="memory is read from /proc")
def test_two_hundred_topics_and_fifty_nodes_leak_nothing_and_lose_no_latched_message() -> None:
    report = run_load(20.0)
    assert report.received > 0
    assert report.newcomers > 1
    assert report.faults == [], report


def test_a_node_works_after_ten_thousand_short_connections(graph: Any) -> None:
    node = graph.node("n")
    publisher = node.advertise("/a", "std_msgs/String", latch=True)
    publisher.publish({"data": "still here"})
    graph.ready(node)
    port = blocking_call(node.uri, "requestTopic", "/me", "/a", [["TCPROS"]], timeout_s=PATIENCE_S)[2][2]
    for target in (graph.core.port, port):
        for _ in range(5000):
            socket.create_connection(("127.0.0.1", target), timeout=PATIENCE_S).close()
    got: list[str] = []
    graph.node("m").subscribe("/a", "std_msgs/String", lambda m: got.append(m.data))
    graph.until(lambda: got == ["still here"])
    assert MasterProxy(graph.core.uri).call("getPublishedTopics", "") is not None
