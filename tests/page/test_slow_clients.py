"""A client that does not read does not slow down others; it loses the oldest messages of streams, which are counted."""

import json
from collections.abc import Iterator

import numpy as np
import pytest
from tests.graphs import Graph, running_graph
from tests.manifests import empty_manifest
from tests.page_client import ProtocolClient
from tests.throttled_link import ThrottledLink

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, Session
from trundle.ros import Messages

MB = 1024 * 1024
COUNT = 60
SIZE = (480, 640)
"""Height and width of images of 900 kB."""
FOXGLOVE = "foxglove.websocket.v1"


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
        stalled.until(lambda: [payload[-1] for payload in stalled.payloads("/cloud")][-1:] == [COUNT - 1])
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


def test_a_slow_client_gets_the_newest_poses_and_transforms(graph: Graph, graph_page: PageServer) -> None:
    node = graph.node("robot")
    cloud = node.advertise("/flood", "std_msgs/UInt8MultiArray")
    frames = node.advertise("/tf", "tf2_msgs/TFMessage")
    graph_page.set_world(empty_manifest(1), {})
    numbers = range(100, 140)
    with Stalled(graph_page.url) as stalled, ProtocolClient(graph_page.url) as reader:
        for client in (stalled, reader):
            for topic in ("/flood", "/tf", "trundle/poses"):
                client.subscribe(topic)
        graph.until(lambda: cloud.has_subscribers and frames.has_subscribers)
        for count in range(1, 21):
            cloud.publish({"data": np.zeros(MB, np.uint8)})
            reader.until(lambda n=count: len(reader.payloads("/flood")) >= n)
        frames.publish({"transforms": [{"child_frame_id": "arm"}]})
        for count, number in enumerate(numbers, 2):
            frames.publish({"transforms": [{"child_frame_id": "base", "header": {"frame_id": str(number)}}]})
            reader.until(lambda n=count: len(reader.payloads("/tf")) >= n)
            graph_page.put_poses(number, np.full((3, 7), float(number)))
            reader.until(lambda n=number: n in [payload[0] for payload in reader.payloads("trundle/poses")])
        last = str(numbers[-1]).encode()
        stalled.until(lambda: any(last in payload for payload in stalled.payloads("/tf")))
        stalled.until(lambda: numbers[-1] in [payload[0] for payload in stalled.payloads("trundle/poses")])

    transforms = stalled.payloads("/tf")
    assert any(b"arm" in payload for payload in transforms)
    assert len(transforms) < len(numbers) + 1
    for publisher in (cloud, frames):
        publisher.unregister()


def test_a_slow_client_is_up_to_date_and_the_others_get_everything(graph: Graph, graph_page: PageServer) -> None:
    """Behind 100 kB/s: what is on its way is bounded, whether or not the client acknowledges by itself."""
    node = graph.node("camera")
    scan = node.advertise("/scan", "std_msgs/UInt8MultiArray")
    image = node.advertise("/image", "std_msgs/UInt8MultiArray")
    with (
        ThrottledLink(graph_page.url, bytes_per_s=100e3, buffer_bytes=4 * MB) as link,
        ProtocolClient(graph_page.url, protocol=FOXGLOVE) as reader,
        ProtocolClient(link.url) as page,
        ProtocolClient(link.url, protocol=FOXGLOVE) as foxglove,
    ):
        slow = {"page": page, "foxglove": foxglove}
        newest: dict[str, list[int]] = {name: [] for name in slow}
        """Number of scans that a slow client was behind whenever it got one."""
        for client in (reader, page, foxglove):
            for topic in ("/scan", "/image"):
                client.subscribe(topic)
        graph.until(lambda: scan.has_subscribers and image.has_subscribers)
        for number in range(COUNT * 2):
            scan.publish({"data": np.full(1000, number, np.uint8)})
            image.publish({"data": np.full(60_000, number, np.uint8)})
            for name, client in slow.items():
                client.settle(0.02)
                scans = client.payloads("/scan")
                newest[name].append(number - scans[-1][-1] if scans else number)
            # Each is waited for: on a busy machine this client would be slow, too.
            reader.until(lambda: len(reader.payloads("/scan")) == len(reader.payloads("/image")) == number + 1)  # noqa: B023

    for name, client in slow.items():
        behind = sorted(newest[name][COUNT:])
        assert behind[len(behind) // 2] < COUNT // 2, (name, behind)  # without a bound, most of them
        assert len(client.payloads("/scan")) > 2 * len(client.payloads("/image")) > 0
    for publisher in (scan, image):
        publisher.unregister()


@pytest.mark.slow
def test_long_messages_do_not_block_a_client_of_the_foxglove_protocol(graph: Graph, graph_page: PageServer) -> None:
    """Behind 100 kB/s an image of 900 kB would take 9 s: it has fewer pixels; what has no pixels is not sent."""
    node = graph.node("long_messages")
    types = {"/scan": "std_msgs/UInt8MultiArray", "/blob": "std_msgs/UInt8MultiArray", "/picture": "sensor_msgs/Image"}
    topics = {topic: node.advertise(topic, type_name) for topic, type_name in types.items()}
    pixels = np.zeros((*SIZE, 3), np.uint8)
    image: dict[str, object] = {"height": SIZE[0], "width": SIZE[1], "encoding": "rgb8", "step": 3 * SIZE[1]}
    behind: list[int] = []
    """Number of scans that the client was behind whenever one was published."""
    with (
        ThrottledLink(graph_page.url, bytes_per_s=100e3, buffer_bytes=4 * MB) as link,
        ProtocolClient(graph_page.url, protocol=FOXGLOVE) as reader,
        ProtocolClient(link.url, protocol=FOXGLOVE) as slow,
    ):
        reader.subscribe("/picture")
        subscribed = {topic: slow.subscribe(topic) for topic in types}
        graph.until(lambda: all(publisher.has_subscribers for publisher in topics.values()))
        for number in range(250):
            topics["/picture"].publish(image | {"data": pixels.reshape(-1)})
            topics["/blob"].publish({"data": np.zeros(200_000, np.uint8)})
            topics["/scan"].publish({"data": np.full(1000, number, np.uint8)})
            slow.settle(0.02)
            reader.settle(0.0)
            scans = slow.payloads("/scan")
            behind.append(number - scans[-1][-1] if scans else number)
        pictures = [Messages().deserialize(data, "sensor_msgs/Image") for data in slow.payloads("/picture")]
        blobs = len(slow.payloads("/blob"))
        reports = {status.get("id"): status["message"] for status in slow.statuses}
        for topic in ("/scan", "/picture"):
            slow.unsubscribe(subscribed[topic])
        topics["/blob"].publish({"data": np.zeros(200_000, np.uint8)})
        slow.until(lambda: slow.payloads("/blob"))
        slow.last("removeStatus")

    assert max(behind) < 100, behind  # blocked for 9 s, all of them
    assert len(pictures) > 2
    assert all(0 < picture.width < SIZE[1] // 2 and picture.data.size < 60_000 for picture in pictures)
    assert all(len(data) > pixels.nbytes for data in reader.payloads("/picture"))
    assert blobs == 0
    assert "fewer pixels" in reports["reduced/picture"]
    assert "none is sent" in reports["reduced/blob"]
    for publisher in topics.values():
        publisher.unregister()
