"""A view-only client changes nothing, whatever it sends."""

import json
import struct
import typing
from collections.abc import Iterator
from contextlib import ExitStack
from typing import Any

import pytest
from msgspec import inspect
from tests.graphs import Graph, running_graph
from tests.page_client import ProtocolClient

from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, Session
from trundle.page.clients.protocol import ClientOperation
from trundle.page.requests.request import ClientAction, SaveRvizAs

REFUSAL = "this link is view-only"
READ_ONLY = {
    "subscribe", "unsubscribe", "getParameters", "subscribeParameterUpdates", "unsubscribeParameterUpdates",
    "subscribeConnectionGraph", "unsubscribeConnectionGraph", "fetchAsset", "trundle/presence", "trundle/request",
    "trundle/echo",
}  # fmt: skip
"""Operations that change nothing; requests are listed separately."""
_MORE: dict[str, dict[str, Any]] = {"joint": {"position": 1.0}}
"""Fields that requests need in addition to those without a default."""


def _sample(kind: inspect.Type) -> Any:
    """Return a value of a type in JSON's types."""
    match kind:
        case inspect.StructType(fields=fields):
            return {field.encode_name: _sample(field.type) for field in fields if field.required}
        case inspect.LiteralType(values=values):
            return values[0]
        case inspect.TupleType(item_types=items):
            return [_sample(item) for item in items]
        case inspect.VarTupleType(item_type=item):
            return [_sample(item)]
        case inspect.UnionType(types=types):
            return _sample(next(member for member in types if not isinstance(member, inspect.NoneType)))
        case inspect.BoolType():
            return True
        case inspect.StrType():
            return "x"
        case _:
            return 1


def _messages(union: Any, *more: type) -> list[tuple[str, dict[str, Any]]]:
    """Return tag and an example message of each struct in a union."""
    kinds = [inspect.type_info(member) for member in (*typing.get_args(union), *more)]
    assert all(isinstance(kind, inspect.StructType) for kind in kinds)
    return [(str(kind.tag), _sample(kind)) for kind in kinds if isinstance(kind, inspect.StructType)]


OPERATIONS = [operation for operation in _messages(ClientOperation) if operation[0] not in READ_ONLY]
REQUESTS = _messages(ClientAction, SaveRvizAs)


@pytest.fixture(scope="module")
def graph() -> Iterator[Graph]:
    with running_graph() as graph:
        yield graph


@pytest.fixture(
    scope="module",
    params=["loopback", pytest.param("every interface", marks=pytest.mark.slow)],
)
def page(request: pytest.FixtureRequest, graph: Graph) -> Iterator[PageServer]:
    at = PageAddress(host="0.0.0.0" if request.param == "every interface" else "127.0.0.1", port=0)
    address = GraphAddress(master_uri=graph.core.uri)
    with PageServer.start(Session(title="t", kind="simulation"), at=at, graph=address) as page:
        yield page


@pytest.fixture(scope="module")
def viewer(page: PageServer) -> Iterator[ProtocolClient]:
    with ProtocolClient(page.view_url) as viewer:
        viewer.until(lambda: viewer.channels)
        yield viewer


def test_the_lists_have_operations_and_requests() -> None:
    assert {"advertise", "setParameters", "trundle/drive", "trundle/release"} <= {op for op, _ in OPERATIONS}
    assert {"play", "seek", "pose", "wrench", "insert", "delete", "save_world"} <= {name for name, _ in REQUESTS}
    assert not READ_ONLY - {op for op, _ in _messages(ClientOperation)}


@pytest.mark.parametrize(("op", "fields"), OPERATIONS, ids=[op for op, _ in OPERATIONS])
def test_operations_are_refused(viewer: ProtocolClient, op: str, fields: dict[str, Any]) -> None:
    before = len(viewer.statuses)
    viewer.send(op, **fields)
    viewer.until(lambda: len(viewer.statuses) > before)

    assert viewer.statuses[-1] == {"op": "status", "level": 2, "message": REFUSAL}


@pytest.mark.parametrize(("name", "fields"), REQUESTS, ids=[name for name, _ in REQUESTS])
def test_requests_are_refused_and_do_not_reach_the_owner(
    page: PageServer, viewer: ProtocolClient, name: str, fields: dict[str, Any]
) -> None:
    message = fields | _MORE.get(name, {}) | {"id": f"my {name}", "request": name}
    viewer.send("trundle/request", **message)
    viewer.until(lambda: any(message.get("id") == f"my {name}" for message in viewer.jsons))

    assert viewer.last("trundle/response") == {
        "op": "trundle/response", "id": f"my {name}", "ok": False, "error": REFUSAL,
    }  # fmt: skip
    assert page.requests() == []


def test_the_graph_is_not_changed(graph: Graph, page: PageServer, viewer: ProtocolClient) -> None:
    """Tests topics, parameters and services by raw messages of the protocol."""
    node = graph.node("watched")
    calls: list[object] = []
    received: list[object] = []
    node.advertise_service("/press", "std_srvs/Trigger", calls.append)
    subscription = node.subscribe("/cmd_vel", "geometry_msgs/Twist", received.append)
    graph.ready(node)
    graph.loop.run(node.params.set("/kept", 1))
    with ExitStack() as stack:
        viewers = [viewer, stack.enter_context(ProtocolClient(page.view_url, protocol="foxglove.websocket.v1"))]
        for client in viewers:
            client.until(lambda client=client: "/press" in client.services)
            channel = {"id": 1, "topic": "/cmd_vel", "encoding": "ros1", "schemaName": "geometry_msgs/Twist"}
            client.send("advertise", channels=[channel])
            client.socket.send(struct.pack("<BI", 1, 1) + bytes(48))
            client.send("setParameters", parameters=[{"name": "/kept", "value": 2}], id="set")
            client.socket.send(struct.pack("<BIII", 2, client.services["/press"]["id"], 7, 4) + b"ros1")
            assert client.last("serviceCallFailure")["message"] == REFUSAL
            client.send("getParameters", parameterNames=["/kept"], id="get")
            assert client.last("parameterValues")["parameters"] == [{"name": "/kept", "value": 1}]
            assert [status["message"] for status in client.statuses][-3:] == [REFUSAL] * 3
    assert (calls, received, subscription.publishers) == ([], [], 0)


def test_a_view_only_session_has_only_view_only_addresses(page: PageServer, viewer: ProtocolClient) -> None:
    """This holds for HTTP and for the channel of the session."""
    viewer.subscribe("trundle/session")
    viewer.until(lambda: viewer.payloads("trundle/session"))
    session = json.loads(viewer.payloads("trundle/session")[-1])
    control = page.foxglove_url.partition("token=")[2]

    assert session["view_only"]
    assert page.view_url.endswith(session["view_token"])
    assert session["token"] is None
    assert session["foxglove"] == page.view_url.replace("http", "ws", 1)
    assert not any(control in json.dumps(message) for message in viewer.jsons)
    assert control not in json.dumps(session)
    assert not {"clientPublish", "services"} & set(viewer.last("serverInfo")["capabilities"])
    with ProtocolClient(page.foxglove_url.replace("ws", "http", 1)) as other:
        assert {"clientPublish", "services"} <= set(other.last("serverInfo")["capabilities"])
        other.subscribe("trundle/session")
        other.until(lambda: other.payloads("trundle/session"))
        assert not json.loads(other.payloads("trundle/session")[-1])["view_only"]


def test_read_only_requests_are_answered(viewer: ProtocolClient) -> None:
    viewer.send("trundle/request", id="type", request="definition", type="std_msgs/String")
    viewer.until(lambda: any(message.get("id") == "type" for message in viewer.jsons))

    assert viewer.last("trundle/response")["definition"] == "string data\n"
