"""rosbridge's protocol, over WebSocket and TCP."""

import base64
import io
import json
import socket

import pytest
from PIL import Image
from tests.gazebo.nodes.bridge_client import BridgeClient, connected, port_of
from websockets.exceptions import InvalidStatus

STRING = "std_msgs/String"


@pytest.fixture
def bridge(graph):
    graph.start("rosbridge_server/rosbridge_websocket", "--port 0")
    with connected(port_of(graph, "rosbridge_websocket")) as client:
        yield client


def test_messages_of_a_client_reach_the_graph(graph, bridge: BridgeClient) -> None:
    messages = graph.listen("/chatter", STRING)
    bridge.send("advertise", topic="/chatter", type=STRING, id="a")
    bridge.send("publish", topic="/chatter", msg={"data": "hello"})

    graph.until(lambda: [m.data for m in messages] == ["hello"])


def test_messages_are_read_from_json(graph, bridge: BridgeClient) -> None:
    images = graph.listen("/image", "sensor_msgs/Image")
    poses = graph.listen("/pose", "geometry_msgs/PoseWithCovarianceStamped")
    bridge.send("advertise", topic="/image", type="sensor_msgs/Image")
    bridge.send("advertise", topic="/pose", type="geometry_msgs/PoseWithCovarianceStamped")
    data = base64.b64encode(b"\0\1\2").decode()
    bridge.send("publish", topic="/image", msg={"header": {"frame_id": "eye"}, "encoding": "rgb8", "data": data})
    bridge.send("publish", topic="/image", msg={"header": {"stamp": {"secs": 3, "nsecs": 4}}, "data": [5, 6]})
    bridge.send("publish", topic="/pose", msg={"pose": {"pose": {"position": {"x": 1}}, "covariance": [0.5] * 36}})
    graph.until(lambda: len(images) == 2 and poses)

    assert (images[0].data.tobytes(), images[0].header.frame_id) == (b"\0\1\2", "eye")
    assert images[0].header.stamp.sec > 1e9, "a header without a stamp is stamped now"
    assert (images[1].header.stamp.sec, images[1].header.stamp.nanosec) == (3, 4)
    assert images[1].data.tobytes() == b"\5\6"
    assert (poses[0].pose.pose.position.x, poses[0].pose.covariance[35]) == (1.0, 0.5)
    assert poses[0].header.stamp.sec == 0, "a header that is not given is not stamped"


def test_messages_arrive_as_json(graph, bridge: BridgeClient) -> None:
    source = graph.client.advertise("/scan", "sensor_msgs/LaserScan", latch=True)
    source.publish({"header": {"stamp": 1_500_000_002}, "ranges": [1.0, float("nan"), float("inf")]})
    bridge.send("subscribe", topic="/scan", type="sensor_msgs/LaserScan", id="s1")
    message = bridge.receive()

    assert (message["op"], message["topic"]) == ("publish", "/scan")
    assert message["msg"]["ranges"] == [1.0, None, None]
    assert message["msg"]["header"]["stamp"] == {"secs": 1, "nsecs": 500_000_002}


def test_messages_arrive_as_png_and_cbor(graph, bridge: BridgeClient) -> None:
    source = graph.client.advertise("/image", "sensor_msgs/Image", latch=True)
    source.publish({"width": 300, "data": b"abc"})
    graph.client.advertise("/floats", "std_msgs/Float32MultiArray", latch=True).publish({"data": [1.0, -2.0]})
    bridge.send("subscribe", topic="/image", type="sensor_msgs/Image", compression="png")
    packed = bridge.receive()
    pixels = Image.open(io.BytesIO(base64.b64decode(packed["data"]))).tobytes()
    bridge.send("subscribe", topic="/floats", compression="cbor")
    tree = bridge.receive_raw()
    bridge.send("unsubscribe", topic="/image")
    bridge.send("subscribe", topic="/image", compression="cbor-raw")
    raw = bridge.receive_raw()

    assert packed["op"] == "png"
    assert json.loads(pixels.decode())["msg"]["data"] == "YWJj"
    assert isinstance(tree, bytes)
    assert tree.startswith(b"\xa3\x62op\x67publish\x65topic\x67/floats\x63msg\xa2\x66layout")
    assert tree.endswith(b"\x64data\xd8\x55\x48\0\0\x80\x3f\0\0\0\xc0"), "little-endian, tag 85"
    assert isinstance(raw, bytes)
    assert b"\x65bytes" in raw
    assert (
        graph.client.messages.serialize(graph.client.new("sensor_msgs/Image", {"width": 300, "data": b"abc"}))[12:]
        in raw
    )


def test_a_throttled_queue_keeps_the_newest(graph, bridge: BridgeClient) -> None:
    source = graph.client.advertise("/count", "std_msgs/Int32", queue_size=None)
    bridge.send("subscribe", topic="/count", type="std_msgs/Int32", throttle_rate=1000, queue_length=2)
    graph.until(lambda: source.has_subscribers)
    source.publish({"data": 0})
    first = bridge.receive()
    for number in range(1, 10):
        source.publish({"data": number})

    assert [m["msg"]["data"] for m in (first, bridge.receive(), bridge.receive())] == [0, 8, 9]


def test_a_service_is_called(graph, bridge: BridgeClient) -> None:
    graph.client.advertise_service("/add", "rospy_tutorials/AddTwoInts", lambda request: {"sum": request.a + request.b})
    graph.loop.run(graph.client.wait_registered())
    bridge.send("call_service", service="/add", args={"a": 2, "b": 3}, id="call:1")
    named = bridge.receive()
    bridge.send("call_service", service="/add", args=[4, 5])
    listed = bridge.receive()
    bridge.send("call_service", service="/no", id=7)
    status, failed = bridge.receive(), bridge.receive()

    assert named == {
        "op": "service_response", "service": "/add", "values": {"sum": 5}, "result": True, "id": "call:1"
    }  # fmt: skip
    assert listed["values"] == {"sum": 9}
    assert (status["op"], status["level"], status["id"]) == ("status", "error", 7)
    assert (failed["values"], failed["result"], failed["id"]) == ("Service /no does not exist", False, 7)


def test_a_client_provides_a_service(graph, bridge: BridgeClient) -> None:
    bridge.send("advertise_service", service="/double", type="rospy_tutorials/AddTwoInts")
    graph.loop.run(graph.client.wait_for_service("/double", 60.0))
    response = graph.loop.spawn(graph.client.call_service("/double", "rospy_tutorials/AddTwoInts", {"a": 4}))
    request = bridge.receive()
    bridge.send("service_response", service="/double", id=request["id"], values={"sum": 8}, result=True)

    assert (request["op"], request["service"], request["args"]) == ("call_service", "/double", {"a": 4, "b": 0})
    assert response.result(60.0).sum == 8

    bridge.send("unadvertise_service", service="/double")
    graph.until(lambda: "/double" not in graph.client.loop.run(_services(graph)))


async def _services(graph) -> dict[str, list[str]]:
    return dict((await graph.client.master.call("getSystemState"))[2])


def test_fragments_are_received_and_sent(graph, bridge: BridgeClient) -> None:
    messages = graph.listen("/chatter", STRING)
    text = json.dumps({"op": "advertise", "topic": "/chatter", "type": STRING})
    for number, data in ((1, text[20:]), (0, text[:20])):
        bridge.send("fragment", id="f", num=number, total=2, data=data)
    bridge.send("publish", topic="/chatter", msg={"data": "x"})
    graph.until(lambda: messages)
    graph.client.advertise("/long", STRING, latch=True).publish({"data": "y" * 250})
    bridge.send("subscribe", topic="/long", type=STRING, fragment_size=100)
    parts = [bridge.receive() for _ in range(3)]

    assert [(part["op"], part["num"], part["total"]) for part in parts] == [("fragment", n, 3) for n in range(3)]
    assert json.loads("".join(part["data"] for part in parts))["msg"] == {"data": "y" * 250}


FAULTS = {
    "advertise: Expected a topic field but none was found.": {"op": "advertise"},
    "publish: Cannot infer topic type for topic /x as it is not yet advertised": {"op": "publish", "topic": "/x"},
    "subscribe: Cannot infer topic type for topic /x as it is not yet advertised": {"op": "subscribe", "topic": "/x"},
    "advertise: Tried to register topic /rosout with type std_msgs/String but it is already established with type "
    "rosgraph_msgs/Log": {"op": "advertise", "topic": "/rosout", "type": STRING},
    "publish: std_msgs/String message requires a string for field data, but got a <class 'int'>": {
        "op": "publish", "topic": "/c", "msg": {"data": 5}
    },
    "publish: Message type std_msgs/String does not have a field date": {
        "op": "publish", "topic": "/c", "msg": {"date": ""}
    },
    "publish: Expected a JSON object for type std_msgs/String but received a <class 'list'>": {
        "op": "publish", "topic": "/c", "msg": []
    },
}  # fmt: skip


def test_errors_have_the_originals_text(bridge: BridgeClient) -> None:
    bridge.send("advertise", topic="/c", type=STRING)
    for text, message in FAULTS.items():
        bridge.socket.send(json.dumps({**message, "id": "q"}))

        assert bridge.receive() == {"op": "status", "level": "error", "msg": text, "id": "q"}


def test_a_client_sets_its_status_level(bridge: BridgeClient) -> None:
    bridge.send("set_level", level="none")
    bridge.send("nonsense")
    bridge.send("set_level", level="info")
    bridge.send("subscribe", topic="/c", type=STRING)

    assert bridge.receive() == {"op": "status", "level": "info", "msg": "Subscribed to /c"}


def test_globs_hide_topics_and_services(graph) -> None:
    graph.start("rosbridge_server/rosbridge_websocket", port=0, topics_glob="['/open/*']", services_glob="[/none]")
    with connected(port_of(graph, "rosbridge_websocket")) as client:
        client.send("set_level", level="warning")
        client.send("advertise", topic="/closed", type=STRING)
        assert client.receive()["msg"] == "No match found for topic, cancelling advertisement of: /closed"
        client.send("call_service", service="/rosout/get_loggers")
        assert client.receive()["msg"].startswith("No match found for service")
        client.send("publish", topic="/open/x", msg={})
        assert client.receive()["msg"].startswith("publish: Cannot infer")


def test_a_disconnected_client_is_unregistered(graph) -> None:
    counts = graph.listen("/client_count", "std_msgs/Int32")
    graph.start("rosbridge_server/rosbridge_websocket", port=0, unregister_timeout=0)
    port = port_of(graph, "rosbridge_websocket")
    with connected(port) as client:
        client.send("advertise", topic="/advertised", type=STRING)
        client.send("subscribe", topic="/subscribed", type=STRING)
        client.send("advertise_service", service="/service", type="std_srvs/Empty")
        graph.loop.run(graph.client.wait_for_service("/service", 60.0))

    def names() -> set[str]:
        tables = graph.loop.run(graph.client.master.call("getSystemState"))
        return {name for table in tables for name, _ in table}

    graph.until(lambda: not names() & {"/advertised", "/subscribed", "/service"})
    graph.until(lambda: [m.data for m in counts] == [0, 1, 0])


@pytest.mark.parametrize(
    ("origin", "params", "is_served"),
    [
        ("http://localhost:8000", {}, True),
        ("http://127.0.0.1:5173", {}, True),
        ("http://evil.example", {}, False),
        ("http://localhost.evil.example", {}, False),
        ("null", {}, False),
        ("null", {"websocket_null_origin": True}, True),
        ("https://panel.example", {"allowed_origins": "https://panel.example"}, True),
        ("http://evil.example", {"allowed_origins": "*"}, True),
    ],
)
def test_only_pages_of_this_machine_are_served(graph, origin: str, params: dict[str, object], is_served: bool) -> None:
    graph.start("rosbridge_server/rosbridge_websocket", port=0, **params)
    port = port_of(graph, "rosbridge_websocket")
    if is_served:
        with connected(port, origin=origin) as client:
            client.send("nonsense")
            assert client.receive()["op"] == "status"
    else:
        with pytest.raises(InvalidStatus) as refused, connected(port, origin=origin):
            pass
        assert refused.value.response.status_code == 403
        assert b"~allowed_origins" in refused.value.response.body


@pytest.mark.parametrize("server", ["rosbridge_websocket", "rosbridge_tcp"])
def test_missing_access_control_is_reported(graph, server: str) -> None:
    messages = graph.listen("/rosout", "rosgraph_msgs/Log")
    graph.start(f"rosbridge_server/{server}", port=0)
    warning = "ROS has no access control: every user of this machine may connect here; set ~token to require one"
    graph.until(lambda: [log.msg for log in messages if log.level == 4] == [warning])


def test_a_token_is_required_on_loopback_too(graph) -> None:
    messages = graph.listen("/rosout", "rosgraph_msgs/Log")
    graph.start("rosbridge_server/rosbridge_websocket", port=0, token="sesame")
    port = port_of(graph, "rosbridge_websocket")
    with pytest.raises(InvalidStatus), connected(port):
        pass
    with connected(port, path="/?token=sesame") as client:
        client.send("nonsense")
        assert client.receive()["op"] == "status"
    graph.until(lambda: any("started" in log.msg for log in messages))
    assert not any("sesame" in log.msg for log in messages)


def test_over_tcp_the_first_message_is_the_token(graph) -> None:
    graph.start("rosbridge_server/rosbridge_tcp", port=0, token="sesame")
    address = ("127.0.0.1", port_of(graph, "rosbridge_tcp"))
    for first in ({"op": "nonsense"}, {"op": "auth", "mac": "guess"}, {"op": "auth"}):
        with socket.create_connection(address, 60.0) as client:
            client.sendall(json.dumps(first).encode() + b'{"op": "nonsense"}')
            assert client.recv(100) == b""
    with socket.create_connection(address, 60.0) as client:
        client.sendall(b'{"op": "auth", "mac": "sesame"}{"op": "nonsense"}')
        assert b"Unknown operation: nonsense" in client.recv(65536)


def test_other_machines_must_send_the_token(graph) -> None:
    graph.start("rosbridge_server/rosbridge_websocket", port=0, address="0.0.0.0", token="sesame")
    port = port_of(graph, "rosbridge_websocket")
    with pytest.raises(InvalidStatus), connected(port):
        pass
    with connected(port, path="/?token=sesame", origin="http://phone.example") as client:
        client.send("nonsense")
        assert client.receive()["op"] == "status"


@pytest.mark.parametrize(
    "params", [{"bson_only_mode": True}, {"authenticate": True}, {"port": "x"}, {"allowed_origins": "evil"},
               {"certfile": "/none.pem"}]
)  # fmt: skip
def test_invalid_parameters_end_it(graph, params: dict[str, object]) -> None:
    assert graph.start("rosbridge_server/rosbridge_websocket", **params).result(60.0) == 1


def test_json_objects_are_split_from_a_tcp_stream(graph) -> None:
    messages = graph.listen("/chatter", STRING)
    graph.start("rosbridge_server/rosbridge_tcp", port=0)
    with socket.create_connection(("127.0.0.1", port_of(graph, "rosbridge_tcp")), 60.0) as client:
        sent = (
            json.dumps({"op": "advertise", "topic": "/chatter", "type": STRING})
            + json.dumps({"op": "publish", "topic": "/chatter", "msg": {"data": 'a } " \\ ö'}}, ensure_ascii=False)
            + json.dumps({"op": "nonsense"})
        ).encode()
        for start in range(0, len(sent), 7):
            client.sendall(sent[start : start + 7])
        graph.until(lambda: [m.data for m in messages] == ['a } " \\ ö'])

        assert b"Unknown operation: nonsense" in client.recv(65536)


def test_http_over_tcp_is_refused(graph) -> None:
    graph.start("rosbridge_server/rosbridge_tcp", port=0)
    with socket.create_connection(("127.0.0.1", port_of(graph, "rosbridge_tcp")), 60.0) as client:
        client.sendall(b'POST / HTTP/1.1\r\nHost: x\r\n\r\n{"op": "nonsense"}')

        assert client.recv(100) == b""


def test_tcp_is_served_on_loopback_only(graph) -> None:
    assert graph.start("rosbridge_server/rosbridge_tcp", "_host:=0.0.0.0 _port:=0").result(60.0) == 1
