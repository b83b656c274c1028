"""Invalid and hostile input is answered or dropped within bounds, without a traceback."""

import json
import random

import pytest
from tests.gazebo.nodes.bridge_client import connected, port_of

from trundle.base.http.send_buffer import SendBuffer
from trundle.gazebo.nodes.rosbridge.errors import RosbridgeError
from trundle.gazebo.nodes.rosbridge.fragments import Reassembly
from trundle.gazebo.nodes.rosbridge.object_splitter import ObjectSplitter

STRING = "std_msgs/String"
OPS = (
    "advertise", "unadvertise", "publish", "subscribe", "unsubscribe", "call_service", "advertise_service",
    "unadvertise_service", "service_response", "fragment", "set_level", "status", "auth", "", None,
)  # fmt: skip
NAMES = ("topic", "type", "id", "msg", "service", "args", "values", "result", "throttle_rate", "queue_length",
         "fragment_size", "compression", "latch", "queue_size", "num", "total", "data", "level")  # fmt: skip
REQUIRED = ("topic", "type", "service", "id", "result", "num", "total", "data")
VALUES = (
    None, True, -1, 0, 1, 10**30, 1e308, "", "/", "/c", "~", "a b", "/\0", "\ud800", "x" * 300, STRING, "std_msgs",
    "std_msgs/None", "a/b/c", "../../etc/passwd", "geometry_msgs/Twist", "std_srvs/Empty", "/rosout/get_loggers",
    [], [[[]]], {}, {"data": "x"}, {"linear": {"x": "NaN"}}, {"a": {}}, "cbor", "cbor-raw", "png", "none",
)  # fmt: skip
TEXTS = (
    "", "{", "[]", "null", "NaN", '"op"', "[" * 100_000, '{"op": ' * 50_000, '{"op": 1e999}', "\ufeff{}", b"\xff\xfe",
    b'{"op": "publish"}', '{"op": "publish", "op": "x"}', "9" * 10_000,
)  # fmt: skip


@pytest.mark.slow
def test_invalid_operations_do_not_disturb_other_clients(graph, capfd: pytest.CaptureFixture[str]) -> None:
    messages = graph.listen("/sane", STRING)
    graph.start("rosbridge_server/rosbridge_websocket", port=0)
    port = port_of(graph, "rosbridge_websocket")
    source = random.Random(7)
    with connected(port) as sane:
        sane.send("advertise", topic="/sane", type=STRING)
        with connected(port) as hostile:
            hostile.send("set_level", level="none")
            for text in TEXTS:
                hostile.socket.send(text)
            for _ in range(1500):
                names = {name for name in REQUIRED if source.random() < 0.8} | {*source.sample(NAMES, 4)}
                fields = {name: source.choice(VALUES) for name in sorted(names)}
                hostile.socket.send(json.dumps({"op": source.choice(OPS), **fields}))
            hostile.send("set_level", level="error")
            hostile.send("nonsense", id="the end")
            while hostile.receive_json_or_bytes().get("id") != "the end":
                pass
        sane.send("publish", topic="/sane", msg={"data": "still here"})
        graph.until(lambda: [m.data for m in messages] == ["still here"])

    assert "Traceback" not in capfd.readouterr().err


def test_fragments_are_bounded() -> None:
    parts = Reassembly(timeout_s=600.0)
    for number in range(100):
        parts.add({"id": str(number), "num": 0, "total": 2, "data": "x"})
    with pytest.raises(RosbridgeError):
        parts.add({"id": "one too many", "num": 0, "total": 2, "data": "x"})
    for wrong in ({"num": 0}, {"num": 2}, {"num": 1, "total": 3}, {"num": -1}, {"num": "1"}):
        with pytest.raises(RosbridgeError):
            parts.add({"id": "1", "num": 1, "total": 2, "data": "y", **wrong})
    with pytest.raises(RosbridgeError, match="more than"):
        parts.add({"id": "1", "num": 1, "total": 2, "data": "y" * (64 * 1024 * 1024)})

    assert parts.add({"id": "2", "num": 1, "total": 2, "data": "y"}) == "xy"


def test_old_fragments_are_dropped() -> None:
    parts = Reassembly(timeout_s=0.0)
    parts.add({"id": "1", "num": 0, "total": 2, "data": "old"})
    parts.add({"id": "2", "num": 0, "total": 2, "data": "other"})

    assert parts.add({"id": "1", "num": 1, "total": 2, "data": "new"}) is None


def test_an_object_without_an_end_is_dropped() -> None:
    splitter = ObjectSplitter()
    assert splitter.feed(b'{"a": "') == []
    with pytest.raises(RosbridgeError, match="more than"):
        splitter.feed(b"x" * (17 * 1024 * 1024))


def test_a_slow_client_has_a_bounded_queue() -> None:
    buffer = SendBuffer()
    accepted = 0
    while buffer.put(b"x" * 1_000_000):
        accepted += 1

    assert 30 < accepted < 40
    assert buffer.is_busy
