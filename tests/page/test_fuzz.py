"""Ten thousand broken messages: the server answers, prints no traceback and does not grow."""

import json
import random
import struct
from pathlib import Path
from typing import Any

import pytest
from tests.graphs import running_graph
from tests.page_client import ProtocolClient

from trundle.page import GraphAddress, PageServer, Session
from trundle.page_address import PageAddress

pytestmark = pytest.mark.slow
MESSAGES = 10_000
GROWTH_BYTES = 40_000_000
OPERATIONS: list[dict[str, Any]] = [
    {"op": "subscribe", "subscriptions": [{"id": 1, "channelId": 3}]},
    {"op": "unsubscribe", "subscriptionIds": [1]},
    {"op": "advertise", "channels": [
        {"id": 1, "topic": "/fuzz", "encoding": "ros1", "schemaName": "std_msgs/String", "schema": "string data"}]},
    {"op": "unadvertise", "channelIds": [1]},
    {"op": "getParameters", "parameterNames": ["/a"], "id": "x"},
    {"op": "setParameters", "parameters": [{"name": "/a", "value": 1, "type": "float64"}], "id": "x"},
    {"op": "subscribeParameterUpdates", "parameterNames": ["/a"]},
    {"op": "unsubscribeParameterUpdates", "parameterNames": []},
    {"op": "subscribeConnectionGraph"},
    {"op": "unsubscribeConnectionGraph"},
    {"op": "fetchAsset", "uri": "package://robot/a.stl", "requestId": 1},
    {"op": "trundle/drive", "topic": "/cmd_vel", "linear": 1.0, "angular": 0.0},
    {"op": "trundle/release", "topic": "/cmd_vel"},
    {"op": "trundle/request", "id": 1, "request": "step", "count": 1},
    {"op": "trundle/request", "id": 1, "request": "definition", "type": "std_msgs/String"},
    {"op": "trundle/request", "id": 1, "request": "save_rviz_as", "file": "../none.rviz", "text": ""},
]  # fmt: skip
VALUES: list[Any] = [
    None, True, -1, 0, 2**31, 2**32, 2**64, 2**70, 1e308, -0.5, "", "/", "~", "//", "é\u0000", "x" * 2000, [], {}, [[]],
    {"a": {"b": 1}}, "NaN", "std_msgs/Header", "no_msgs/None", "../../etc/passwd", "file:///etc/passwd", "*",
]  # fmt: skip


def _mutated(value: Any, source: random.Random) -> Any:
    """A value with some part replaced, removed or repeated."""
    if source.random() < 0.15:
        return source.choice(VALUES)
    if isinstance(value, dict):
        kept = {key: _mutated(inner, source) for key, inner in value.items() if key == "op" or source.random() > 0.05}
        return kept | ({source.choice("abc"): source.choice(VALUES)} if source.random() < 0.05 else {})
    if isinstance(value, list):
        return [_mutated(inner, source) for inner in value * source.choice((1, 1, 1, 3))]
    return value


def _message(source: random.Random) -> str | bytes:
    kind = source.random()
    if kind < 0.5:
        operation = source.choice(OPERATIONS)
        return json.dumps(_mutated(operation, source) if source.random() < 0.8 else operation)
    if kind < 0.6:
        text = json.dumps(source.choice(OPERATIONS))
        return text[: source.randrange(len(text))]
    if kind < 0.62:
        return "[" * source.choice((10, 100_000)) + "]"
    if kind < 0.8:
        header = struct.pack("<BI", source.choice((1, 1, 1, 2, 200)), source.choice((0, 1, 1, 2, 2**32 - 1)))
        return header[: source.choice((0, 1, 3, 5, 5))] + source.randbytes(source.choice((0, 4, 50)))
    if kind < 0.95:
        length = source.choice((0, 4, 4, 4, 5, 2**32 - 1))
        call = struct.pack("<BIII", 2, source.randrange(8), source.randrange(100), length)
        return call + source.choice((b"ros1", b"json", b"")) + source.randbytes(source.choice((0, 1, 30)))
    return source.randbytes(source.choice((1, 10, 5000)))


def _resident_bytes(page: PageServer) -> int:
    status = Path(f"/proc/{page.process_id}/status").read_text()
    return 1024 * int(next(line for line in status.splitlines() if line.startswith("VmRSS")).split()[1])


def _wait_for_answer(page: PageServer, client: ProtocolClient, number: str) -> None:
    """Wait until the server has handled all messages so far."""
    for request in page.requests():
        page.respond(request.id)
    client.send("trundle/request", id=number, request="definition", type="std_msgs/String")
    client.until(lambda: any(message.get("id") == number for message in client.jsons))
    client.jsons.clear()


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="needs /proc")
@pytest.mark.parametrize("seed", range(2))
def test_ten_thousand_broken_messages_do_no_harm(seed: int, capfd: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    source = random.Random(seed)
    with running_graph() as graph:
        node = graph.node("ours")
        node.advertise("/chat", "std_msgs/String")
        node.advertise_service("/set", "std_srvs/SetBool", lambda r: {"success": r.data})
        graph.ready(node)
        address = GraphAddress(master_uri=graph.core.uri)
        with PageServer.start(
            Session(title="t", kind="graph"), at=PageAddress(port=0), graph=address, source=tmp_path
        ) as page:
            sizes: list[int] = []
            for _ in range(4):
                with ProtocolClient(page.url) as client:
                    client.until(lambda client=client: "/set" in client.services)
                    for number in range(MESSAGES // 4):
                        client.socket.send(_message(source))
                        if number % 50 == 0:
                            _wait_for_answer(page, client, str(number))
                sizes.append(_resident_bytes(page))
            assert page.alive
            assert sizes[-1] - sizes[0] < GROWTH_BYTES, sizes
    errors = capfd.readouterr().err
    assert "Traceback" not in errors, errors[-5000:]
