"""A client that does not read does not slow down others; it loses the oldest messages of streams, which are counted."""

import json
from collections.abc import Iterator

import numpy as np
import pytest
from tests.graphs import Graph, running_graph
from tests.manifests import empty_manifest
from tests.page_client import ProtocolClient

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, Session

MB = 1024 * 1024
COUNT = 60


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


@pytest.fixture(scope="module")
def graph_page(graph: Graph) -> Iterator[PageServer]:
    address = GraphAddress(master_uri=graph.core.uri)
    with PageServer.start(Session(title="t", kind="graph"), at=PageAddress(port=0), graph=address) as page:
        yield page


class Stalled(ProtocolClient):
    """Client whose socket is read only on request."""

    def __init__(self, url: str) -> None:
        super().__init__(url, max_queue=1)


def test_a_stalled_client_loses_clouds_but_no_markers_maps_or_latched_messages(
    graph: Graph, graph_page: PageServer
) -> None:
    node = graph.node("source")
    topics = {
        "/cloud": node.advertise("/cloud", "std_msgs/UInt8MultiArray"),
        "/markers": node.advertise("/markers", "visualization_msgs/Marker"),
        "/map_updates": node.advertise("/map_updates", "map_msgs/OccupancyGridUpdate"),
        "/latched": node.advertise("/latched", "std_msgs/UInt32", latch=True),
    }
    with Stalled(graph_page.url) as stalled, ProtocolClient(graph_page.url) as reader:
        for client in (stalled, reader):
            for topic in ("trundle/drops", *topics):
                client.subscribe(topic)
        graph.until(lambda: all(publisher.has_subscribers for publisher in topics.values()))
        for number in range(COUNT):
            topics["/cloud"].publish({"data": np.full(MB, number, np.uint8)})
            topics["/markers"].publish({"id": number})
            topics["/map_updates"].publish({"x": number})
            topics["/latched"].publish({"data": number})
            reader.until(lambda n=number: all(len(reader.payloads(topic)) > n for topic in topics))
        stalled.until(lambda: all(len(stalled.payloads(t)) == COUNT for t in topics if t != "/cloud"))
        stalled.until(lambda: stalled.payloads("/cloud")[-1][-1] == COUNT - 1)
        lost = COUNT - len(stalled.payloads("/cloud"))
        stalled.until(
            lambda: json.dumps({"/cloud": lost}).replace(" ", "").encode() in stalled.payloads("trundle/drops")
        )

    clouds = [payload[-1] for payload in stalled.payloads("/cloud")]
    assert clouds == sorted(clouds)
    assert clouds[-1] == COUNT - 1
    assert lost > COUNT // 4
    assert not [p for p in reader.payloads("trundle/drops") if p != b"{}"]
    for topic in ("/markers", "/map_updates", "/latched"):
        assert stalled.payloads(topic) == reader.payloads(topic)
    for publisher in topics.values():
        publisher.unregister()


def test_all_poses_are_sent_after_a_loss(graph_page: PageServer) -> None:
    """Otherwise a body that moved in between would keep its old pose."""
    rows = np.zeros((20_000, 7))
    graph_page.set_world(empty_manifest(1), {})
    with Stalled(graph_page.url) as stalled, ProtocolClient(graph_page.url) as reader:
        for client in (stalled, reader):
            client.subscribe("trundle/poses")
        for number in range(1, 41):
            rows = rows + 1.0
            graph_page.put_poses(number, rows)
            reader.until(lambda n=number: len(reader.payloads("trundle/poses")) >= n)
        rows = rows.copy()
        rows[7, 0] = -1.0
        graph_page.put_poses(99, rows)
        stamp = (99).to_bytes(8, "little")
        for client in (reader, stalled):
            client.until(lambda client=client: stamp in [p[:8] for p in client.payloads("trundle/poses")])

    assert len(stalled.payloads("trundle/poses")) < len(reader.payloads("trundle/poses"))
    assert len(stalled.payloads("trundle/poses")[-1]) == 16 + 20_000 * 32
    assert len(reader.payloads("trundle/poses")[-1]) == 16 + 32


def test_poses_reach_a_slow_client_in_order_with_transforms(graph: Graph, graph_page: PageServer) -> None:
    """Otherwise frames would be drawn ahead of their robot."""
    node = graph.node("robot")
    cloud = node.advertise("/flood", "std_msgs/UInt8MultiArray")
    frames = node.advertise("/tf", "tf2_msgs/TFMessage")
    graph_page.set_world(empty_manifest(1), {})
    numbers = range(100, 120)
    with Stalled(graph_page.url) as stalled, ProtocolClient(graph_page.url) as reader:
        for client in (stalled, reader):
            for topic in ("/flood", "/tf", "trundle/poses"):
                client.subscribe(topic)
        graph.until(lambda: cloud.has_subscribers and frames.has_subscribers)
        for count in range(1, 21):
            cloud.publish({"data": np.zeros(MB, np.uint8)})
            reader.until(lambda n=count: len(reader.payloads("/flood")) >= n)
        for count, number in enumerate(numbers, 1):
            frames.publish({"transforms": [{"child_frame_id": str(number)}]})
            reader.until(lambda n=count: len(reader.payloads("/tf")) >= n)
            graph_page.put_poses(number, np.full((3, 7), float(number)))
            reader.until(lambda n=number: n in [payload[0] for payload in reader.payloads("trundle/poses")])
        stalled.until(lambda: numbers[-1] in [payload[0] for payload in stalled.payloads("trundle/poses")])

    order = [topic for topic, *_ in stalled.messages if topic != "/flood"]
    assert order[-2 * len(numbers) :] == ["/tf", "trundle/poses"] * len(numbers)
    for publisher in (cloud, frames):
        publisher.unregister()
