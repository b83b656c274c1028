"""The page as a node of a real graph: topics, services, parameters, the connection graph."""

import base64
import json
import struct
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest
from tests.graphs import Graph, running_graph
from tests.page_client import ProtocolClient

from trundle.base.http.page_address import PageAddress
from trundle.page import ClockState, GraphAddress, PageServer, Session
from trundle.ros import Core, MasterProxy, Messages, Node, ServiceError
from trundle.ros.xmlrpc.rpc_server import RpcServer

FOXGLOVE = "foxglove.websocket.v1"


@contextmanager
def page_of(graph: Graph, **options: Any) -> Iterator[PageServer]:
    address = GraphAddress(master_uri=graph.core.uri)
    with PageServer.start(Session(title="t", kind="graph"), at=PageAddress(port=0), graph=address, **options) as page:
        yield page


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


@pytest.fixture(scope="module")
def graph_page(graph: Graph) -> Iterator[PageServer]:
    with page_of(graph) as page:
        yield page


@pytest.fixture
def client(graph_page: PageServer) -> Iterator[ProtocolClient]:
    with ProtocolClient(graph_page.url, protocol=FOXGLOVE) as client:
        yield client


def test_messages_arrive_with_unchanged_bytes(graph: Graph, client: ProtocolClient) -> None:
    node = graph.node("talker")
    publisher = node.advertise("/chat", "std_msgs/String")
    client.subscribe("/chat")
    graph.until(lambda: publisher.has_subscribers)
    message = node.new("std_msgs/String", {"data": "hello é"})
    publisher.publish(message)
    client.until(lambda: client.payloads("/chat"))

    offer = client.channels["/chat"]
    assert client.payloads("/chat") == [node.messages.serialize(message)]
    assert (offer["encoding"], offer["schemaName"], offer["schemaEncoding"]) == ("ros1", "std_msgs/String", "ros1msg")
    assert offer["schema"] == node.messages.definition("std_msgs/String")
    publisher.unregister()
    client.until(lambda: "/chat" not in client.channels)


def test_clients_share_one_subscription(graph: Graph, graph_page: PageServer) -> None:
    node = graph.node("sharer")
    publisher = node.advertise("/shared", "std_msgs/String")
    with ProtocolClient(graph_page.url) as one, ProtocolClient(graph_page.url, protocol=FOXGLOVE) as two:
        number = one.subscribe("/shared")
        two.subscribe("/shared")
        graph.until(lambda: publisher.has_subscribers)
        for client in (one, two):  # the server may read a subscription later than the first message

            def is_served(client: ProtocolClient = client) -> bool:
                publisher.publish({"data": "x"})
                return bool(client.payloads("/shared"))

            client.until(is_served)
        assert publisher.subscribers == 1
        one.unsubscribe(number)
        publisher.publish({"data": "y"})
        two.until(lambda: two.payloads("/shared")[-1].endswith(b"y"))
    graph.until(lambda: not publisher.has_subscribers)
    publisher.unregister()


def test_later_clients_get_latched_messages(graph: Graph, graph_page: PageServer) -> None:
    nodes = [graph.node(f"mapper{i}") for i in range(2)]
    publishers = [node.advertise("/latched", "std_msgs/String", latch=True) for node in nodes]
    for number, publisher in enumerate(publishers):
        publisher.publish({"data": str(number)})
    expected = {struct.pack("<I", 1) + str(number).encode() for number in range(2)}
    with ProtocolClient(graph_page.url) as one:
        one.subscribe("/latched")
        one.until(lambda: set(one.payloads("/latched")) == expected)
        with ProtocolClient(graph_page.url) as two:
            two.subscribe("/latched")
            two.until(lambda: set(two.payloads("/latched")) == expected)
    for publisher in publishers:
        publisher.unregister()


def test_an_unknown_type_has_its_publishers_definition(graph: Graph, client: ProtocolClient) -> None:
    """The type is neither shipped nor on the package path."""
    definition = "uint8 a\nPart part\n" + "=" * 80 + "\nMSG: nowhere_msgs/Part\nuint8 b\n"
    node = graph.node("stranger")
    publisher = node.advertise("/strange", "nowhere_msgs/Thing", raw_type=("0" * 32, definition))
    client.subscribe("/strange")
    graph.until(lambda: publisher.has_subscribers)

    def arrives() -> bool:  # the first connection is the page's probe for the definition, which receives no message
        publisher.publish(b"\1\2")
        return b"\1\2" in client.payloads("/strange")

    client.until(arrives)

    assert client.channels["/strange"]["schema"] == definition
    publisher.unregister()


def test_a_topic_of_another_version_of_its_type_is_advertised_again(graph: Graph, client: ProtocolClient) -> None:
    node = graph.node("outdated")
    publisher = node.advertise("/outdated", "std_msgs/String", raw_type=("1" * 32, "uint8 data\n"))
    client.subscribe("/outdated")
    first = client.channels["/outdated"]
    graph.until(lambda: publisher.has_subscribers)
    publisher.publish(b"\7")
    client.until(lambda: client.channels.get("/outdated", first)["id"] != first["id"])
    client.subscribe("/outdated")

    def publish() -> bool:
        publisher.publish(b"\7")
        return bool(client.payloads("/outdated"))

    client.until(publish)
    assert set(client.payloads("/outdated")) == {b"\7"}

    assert client.channels["/outdated"]["schema"] == "uint8 data\n"
    publisher.unregister()


def test_clients_publish(graph: Graph, client: ProtocolClient) -> None:
    node = graph.node("listener")
    received: list[str] = []
    node.subscribe("/goal", "std_msgs/String", lambda m: received.append(m.data))
    channel = {"id": 7, "topic": "/goal", "encoding": "ros1", "schemaName": "std_msgs/String"}
    client.send("advertise", channels=[channel])
    body = struct.pack("<BII", 1, 7, 2) + b"go"

    def publish() -> bool:
        client.socket.send(body)
        return bool(received)

    client.until(publish)
    assert set(received) == {"go"}
    client.socket.send(struct.pack("<BII", 1, 7, 99) + b"go")
    client.until(lambda: any("is not published" in status["message"] for status in client.statuses))
    client.send("unadvertise", channelIds=[7])
    client.until(lambda: "/goal" not in [t for t, _ in graph.loop.run(_published(node))])


async def _published(node: Node) -> list[list[str]]:
    return await node.master.call("getPublishedTopics", "")


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"schemaName": "no_msgs/None"}, "no message type"),
        ({"topic": "not a name"}, "invalid topic name"),
        ({"topic": ""}, "invalid topic name"),
        ({"encoding": "json"}, "encoding must be ros1"),
    ],
)
def test_invalid_client_topics_are_refused(client: ProtocolClient, change: dict[str, str], reason: str) -> None:
    channel = {"id": 1, "topic": "/t", "encoding": "ros1", "schemaName": "std_msgs/String"} | change
    client.send("advertise", channels=[channel])
    client.until(lambda: client.statuses)

    assert reason in client.statuses[0]["message"]


def _call(client: ProtocolClient, name: str, body: bytes, call_id: int = 3) -> None:
    client.until(lambda: name in client.services)
    header = struct.pack("<BIII", 2, client.services[name]["id"], call_id, 4)
    client.socket.send(header + b"ros1" + body)


def test_services_are_advertised_and_called(graph: Graph, client: ProtocolClient) -> None:
    node = graph.node("server")
    service = node.advertise_service("/enable", "std_srvs/SetBool", lambda r: {"success": r.data, "message": "ok"})
    _call(client, "/enable", b"\1")
    client.until(lambda: client.binaries)

    offer = client.services["/enable"]
    assert (offer["type"], offer["requestSchema"].split()[:2]) == ("std_srvs/SetBool", ["bool", "data"])
    assert offer["response"]["schemaName"] == "std_srvs/SetBool_Response"
    assert client.binaries == [struct.pack("<BIII", 3, offer["id"], 3, 4) + b"ros1" + b"\1\2\0\0\0ok"]
    service.unregister()
    client.until(lambda: "/enable" not in client.services)


def test_a_failed_service_call_has_its_reason(graph: Graph, client: ProtocolClient) -> None:
    def fail(_: object) -> None:
        raise ServiceError("the arm is folded")

    node = graph.node("folded")
    node.advertise_service("/unfold", "std_srvs/Trigger", fail)
    _call(client, "/unfold", b"", call_id=9)
    failure = client.last("serviceCallFailure")

    assert (failure["callId"], failure["serviceId"]) == (9, client.services["/unfold"]["id"])
    assert "the arm is folded" in failure["message"]
    _call(client, "/unfold", b"too long", call_id=10)
    client.until(lambda: client.last("serviceCallFailure")["callId"] == 10)


def _values(client: ProtocolClient, request_id: str | None) -> list[dict[str, Any]]:
    def matching() -> list[dict[str, Any]]:
        return [m for m in client.jsons if m["op"] == "parameterValues" and m.get("id") == request_id]

    client.until(matching)
    return matching()[-1]["parameters"]


def test_parameters_are_read_with_their_types(graph: Graph, client: ProtocolClient) -> None:
    node = graph.node("setter")
    tree = {"i": 2, "f": 2.0, "s": "x", "b": True, "l": [1, 2], "fl": [1.0, 2.0], "bytes": b"abc", "n": {"deep": 1}}
    graph.loop.run(node.params.set("/many", tree))
    client.send("getParameters", parameterNames=["/many"], id="q")

    values = {value.pop("name"): value for value in _values(client, "q")}
    assert values == {
        "/many/i": {"value": 2}, "/many/f": {"value": 2.0, "type": "float64"}, "/many/s": {"value": "x"},
        "/many/b": {"value": True}, "/many/l": {"value": [1, 2]},
        "/many/fl": {"value": [1.0, 2.0], "type": "float64_array"}, "/many/n/deep": {"value": 1},
        "/many/bytes": {"value": base64.b64encode(b"abc").decode(), "type": "byte_array"},
    }  # fmt: skip
    client.send("getParameters", parameterNames=[], id="all")
    assert "/run_id" in {value["name"] for value in _values(client, "all")}


def test_parameters_are_set_deleted_and_watched(graph: Graph, client: ProtocolClient, graph_page: PageServer) -> None:
    node = graph.node("reader")
    with ProtocolClient(graph_page.url, protocol=FOXGLOVE) as watcher:
        watcher.send("subscribeParameterUpdates", parameterNames=["/speed"])
        watcher.settle()
        client.send("setParameters", parameters=[{"name": "/speed", "value": 3, "type": "float64"}], id="s")
        assert _values(client, "s") == [{"name": "/speed", "value": 3.0, "type": "float64"}]
        assert type(graph.loop.run(node.params.get("/speed"))) is float
        assert _values(watcher, None) == [{"name": "/speed", "value": 3.0, "type": "float64"}]
        graph.loop.run(node.params.set("/other", 1))
        client.send("setParameters", parameters=[{"name": "/speed"}], id="d")
        assert _values(client, "d") == []
        watcher.until(lambda: _values(watcher, None) == [{"name": "/speed"}])
        assert not graph.loop.run(node.params.has("/speed"))
        assert "/other" not in json.dumps(watcher.jsons)


def test_a_number_beyond_the_range_of_floats_is_refused(client: ProtocolClient) -> None:
    client.send("setParameters", parameters=[{"name": "/huge", "value": 10**400, "type": "float64"}], id="h")
    assert _values(client, "h") == []
    client.until(lambda: any("/huge is not set" in status["message"] for status in client.statuses))


def test_the_first_message_reaches_all_present_subscribers(graph: Graph, client: ProtocolClient) -> None:
    """A goal is published once, right after its topic is advertised."""
    received: list[list[str]] = [[], []]
    nodes = [graph.node(f"hearer{i}") for i in range(2)]
    for node, texts in zip(nodes, received, strict=True):
        node.subscribe("/first_goal", "std_msgs/String", lambda message, texts=texts: texts.append(message.data))
    graph.ready(*nodes)
    client.send("subscribeConnectionGraph")
    client.until(lambda: _subscribers(client, "/first_goal") == ("std_msgs/String", ["/hearer0", "/hearer1"]))
    channel = {"id": 1, "topic": "/first_goal", "encoding": "ros1", "schemaName": "std_msgs/String"}
    client.send("advertise", channels=[channel])
    for text in ("a", "b"):
        client.socket.send(struct.pack("<BII", 1, 1, 1) + text.encode())
    graph.until(lambda: received == [["a", "b"], ["a", "b"]])
    client.socket.send(struct.pack("<BII", 1, 1, 1) + b"c")
    graph.until(lambda: received == [["a", "b", "c"], ["a", "b", "c"]])


def _subscribers(client: ProtocolClient, topic: str) -> tuple[str, list[str]] | None:
    """Return type and nodes of a subscribed topic by the graph's updates."""
    latest: tuple[str, list[str]] | None = None
    for message in client.jsons:
        if message["op"] == "connectionGraphUpdate":
            for entry in message["subscribedTopics"]:
                if entry["name"] == topic:
                    latest = (entry["type"], entry["subscriberIds"])
    return latest


def test_the_connection_graph_is_sent_and_updated(graph: Graph, client: ProtocolClient) -> None:
    node = graph.node("drawer")
    publisher = node.advertise("/drawn", "std_msgs/String")
    graph.ready(node)
    client.send("subscribeConnectionGraph")

    def nodes() -> dict[str, list[str]]:
        latest: dict[str, list[str]] = {}
        for message in client.jsons:
            if message["op"] == "connectionGraphUpdate":
                latest |= {topic["name"]: topic["publisherIds"] for topic in message["publishedTopics"]}
                for name in message["removedTopics"]:
                    latest.pop(name, None)
        return latest

    client.until(lambda: nodes().get("/drawn") == ["/drawer"])
    publisher.unregister()
    client.until(lambda: "/drawn" not in nodes())


def test_simulated_time_is_the_time_of_messages(graph: Graph, graph_page: PageServer) -> None:
    node = graph.node("simulator")
    graph.loop.run(node.params.set("/use_sim_time", True))
    clock = node.advertise("/clock", "rosgraph_msgs/Clock")
    chat = node.advertise("/sim_chat", "std_msgs/String")
    try:
        with ProtocolClient(graph_page.url) as client:
            client.subscribe("/sim_chat")
            graph.until(lambda: clock.has_subscribers and chat.has_subscribers)

            def tick() -> bool:
                clock.publish({"clock": {"secs": 12, "nsecs": 5}})
                chat.publish({"data": "x"})
                return 12_000_000_005 in client.times and client.messages[-1:] != []

            client.until(tick)
            client.until(lambda: client.messages[-1][1] == 12_000_000_005)
    finally:
        graph.loop.run(node.params.delete("/use_sim_time"))
        clock.unregister()
        chat.unregister()
    with ProtocolClient(graph_page.url) as client:
        client.until(lambda: client.times[-1:] > [10**18])


def test_a_message_before_the_first_clock_has_the_time_of_the_world(graph: Graph) -> None:
    """At 0 it would be a curve's first point, long before the others."""
    node = graph.node("early")
    graph.loop.run(node.params.set("/use_sim_time", True))
    chat = node.advertise("/early_chat", "std_msgs/String")
    try:
        with page_of(graph) as page, ProtocolClient(page.url) as client:
            page.put_state(ClockState(time_ns=7_000_000_000, paused=False))
            client.subscribe("trundle/state")
            client.until(lambda: client.messages)
            client.subscribe("/early_chat")
            graph.until(lambda: chat.has_subscribers)
            chat.publish({"data": "x"})
            client.until(lambda: client.payloads("/early_chat"))
            assert [time for topic, time, _ in client.messages if topic == "/early_chat"] == [7_000_000_000]
    finally:
        graph.loop.run(node.params.delete("/use_sim_time"))
        chat.unregister()


@pytest.mark.slow
def test_the_page_joins_late_and_restarted_masters() -> None:
    with running_graph() as graph:
        uri, port = graph.core.uri, int(graph.core.uri.rstrip("/").rpartition(":")[2])
        graph.loop.run(graph.core.stop(), 60)
        with page_of(graph) as page, ProtocolClient(page.url) as client:
            client.until(lambda: client.statuses)
            assert client.statuses[0]["message"].startswith(f"no ROS master answers at {uri}")
            for round_number in range(2):
                core = Core(graph.loop, port=port)
                graph.loop.run(core.start(), 60)
                graph.loop.run(core.wait_ready(), 60)
                node = graph.node(f"talker{round_number}")
                publisher = node.advertise("/chat", "std_msgs/String")
                client.until(lambda: any(m["op"] == "removeStatus" for m in client.jsons))
                if round_number == 0:
                    client.subscribe("/chat")
                count = len(client.payloads("/chat"))

                def arrives(count: int = count, publisher: Any = publisher) -> bool:
                    publisher.publish({"data": "x"})
                    return len(client.payloads("/chat")) > count

                client.until(arrives)
                client.jsons.clear()
                client.statuses.clear()
                graph.loop.run(node.shutdown(), 60)
                graph.loop.run(core.stop(), 60)
                client.until(lambda: client.statuses)
            graph.core = Core(graph.loop, port=0)
            graph.loop.run(graph.core.start(), 60)


def test_messages_of_the_master_arrive_decoded_the_same(graph: Graph, client: ProtocolClient) -> None:
    """A message with a stamped header, arrays and strings arrives unchanged."""
    node = graph.node("scanner")
    publisher = node.advertise("/scan", "sensor_msgs/LaserScan")
    client.subscribe("/scan")
    graph.until(lambda: publisher.has_subscribers)
    publisher.publish({"header": {"frame_id": "laser", "stamp": {"secs": 3}}, "ranges": [1.0, 2.0]})
    client.until(lambda: client.payloads("/scan"))

    scan = Messages().deserialize(client.payloads("/scan")[0], "sensor_msgs/LaserScan")
    assert (scan.header.frame_id, scan.header.stamp.sec, scan.ranges.tolist()) == ("laser", 3, [1.0, 2.0])
    publisher.unregister()


BAD_ADDRESSES = [f"http://{'a' * 70}.example:80/", "http://robot..example:80/"]


@pytest.mark.parametrize("uri", BAD_ADDRESSES)
def test_a_node_with_an_invalid_address_does_not_hide_others(
    graph: Graph, client: ProtocolClient, uri: str, capfd: pytest.CaptureFixture[str]
) -> None:
    """The types of its topic and service cannot be probed."""
    master, service_uri = MasterProxy(graph.core.uri, "/stray"), uri.replace("http", "rosrpc")
    master.call("registerPublisher", "/stray_topic", "stray_msgs/Unknown", uri)
    master.call("registerService", "/stray_service", service_uri, uri)
    publisher = graph.node("well").advertise("/well", "std_msgs/String")
    client.until(lambda: "/well" in client.channels)
    publisher.unregister()
    client.until(lambda: "/well" not in client.channels)
    master.call("unregisterPublisher", "/stray_topic", uri)
    master.call("unregisterService", "/stray_service", service_uri)
    assert "Traceback" not in capfd.readouterr().err


def test_a_publisher_at_an_invalid_port_does_not_hide_others(graph: Graph, client: ProtocolClient) -> None:
    server = RpcServer(lambda _method, _arguments: (1, "", ["TCPROS", "127.0.0.1", 99_999]))
    graph.loop.run(server.start("127.0.0.1", 0))
    uri = f"http://127.0.0.1:{server.port}/"
    master = MasterProxy(graph.core.uri, "/stray")
    master.call("registerPublisher", "/stray_topic", "stray_msgs/Unknown", uri)
    publisher = graph.node("well").advertise("/well", "std_msgs/String")
    client.until(lambda: "/well" in client.channels)
    publisher.unregister()
    master.call("unregisterPublisher", "/stray_topic", uri)
    graph.loop.run(server.stop())
