"""A client whose link only allows looking changes nothing, whatever it sends."""

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
LOOKING = {
    "subscribe", "unsubscribe", "getParameters", "subscribeParameterUpdates", "unsubscribeParameterUpdates",
    "subscribeConnectionGraph", "unsubscribeConnectionGraph", "fetchAsset", "trundle/presence", "trundle/request",
}  # fmt: skip
"""Operations that change nothing; requests have a table of their own."""
_MORE: dict[str, dict[str, Any]] = {"joint": {"position": 1.0}}
"""Fields that a request needs beside those without a default."""


def _sample(kind: inspect.Type) -> Any:
    """Return a value of a type as JSON has it."""
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
            return _sample(next(each for each in types if not isinstance(each, inspect.NoneType)))
        case inspect.BoolType():
            return True
        case inspect.StrType():
            return "x"
        case _:
            return 1


def _messages(union: Any, *more: type) -> list[tuple[str, dict[str, Any]]]:
    """Return the tag of each struct of a union, with a message of its kind."""
    kinds = [inspect.type_info(each) for each in (*typing.get_args(union), *more)]
    assert all(isinstance(kind, inspect.StructType) for kind in kinds)
    return [(str(kind.tag), _sample(kind)) for kind in kinds if isinstance(kind, inspect.StructType)]


OPERATIONS = [each for each in _messages(ClientOperation) if each[0] not in LOOKING]
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


def test_there_are_operations_and_requests_to_refuse() -> None:
    assert {"advertise", "setParameters", "trundle/drive", "trundle/release"} <= {op for op, _ in OPERATIONS}
    assert {"play", "seek", "pose", "wrench", "insert", "delete", "save_world"} <= {name for name, _ in REQUESTS}
    assert not LOOKING - {op for op, _ in _messages(ClientOperation)}


@pytest.mark.parametrize(("op", "fields"), OPERATIONS, ids=[op for op, _ in OPERATIONS])
def test_an_operation_is_refused(viewer: ProtocolClient, op: str, fields: dict[str, Any]) -> None:
    before = len(viewer.statuses)
    viewer.send(op, **fields)
    viewer.until(lambda: len(viewer.statuses) > before)

    assert viewer.statuses[-1] == {"op": "status", "level": 2, "message": REFUSAL}


@pytest.mark.parametrize(("name", "fields"), REQUESTS, ids=[name for name, _ in REQUESTS])
def test_a_request_is_refused_and_does_not_reach_the_owner(
    page: PageServer, viewer: ProtocolClient, name: str, fields: dict[str, Any]
) -> None:
    message = fields | _MORE.get(name, {}) | {"id": f"my {name}", "request": name}
    viewer.send("trundle/request", **message)
    viewer.until(lambda: any(each.get("id") == f"my {name}" for each in viewer.jsons))

    assert viewer.last("trundle/response") == {
        "op": "trundle/response", "id": f"my {name}", "ok": False, "error": REFUSAL,
    }  # fmt: skip
    assert page.requests() == []


def test_the_graph_stays_as_it_is(graph: Graph, page: PageServer, viewer: ProtocolClient) -> None:
    """Topics, parameters and services, in raw frames of the protocol."""
    node = graph.node("watched")
    calls: list[object] = []
    heard: list[object] = []
    node.advertise_service("/press", "std_srvs/Trigger", calls.append)
    subscription = node.subscribe("/cmd_vel", "geometry_msgs/Twist", heard.append)
    graph.ready(node)
    graph.loop.run(node.params.set("/kept", 1))
    with ExitStack() as open_things:
        viewers = [viewer, open_things.enter_context(ProtocolClient(page.view_url, protocol="foxglove.websocket.v1"))]
        for each in viewers:
            each.until(lambda each=each: "/press" in each.services)
            channel = {"id": 1, "topic": "/cmd_vel", "encoding": "ros1", "schemaName": "geometry_msgs/Twist"}
            each.send("advertise", channels=[channel])
            each.socket.send(struct.pack("<BI", 1, 1) + bytes(48))
            each.send("setParameters", parameters=[{"name": "/kept", "value": 2}], id="set")
            each.socket.send(struct.pack("<BIII", 2, each.services["/press"]["id"], 7, 4) + b"ros1")
            assert each.last("serviceCallFailure")["message"] == REFUSAL
            each.send("getParameters", parameterNames=["/kept"], id="get")
            assert each.last("parameterValues")["parameters"] == [{"name": "/kept", "value": 1}]
            assert [status["message"] for status in each.statuses][-3:] == [REFUSAL] * 3
    assert (calls, heard, subscription.publishers) == ([], [], 0)


def test_it_is_told_so_and_gets_no_address_that_allows_more(page: PageServer, viewer: ProtocolClient) -> None:
    """Neither by HTTP nor on the channel of the session."""
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


def test_a_question_is_answered(viewer: ProtocolClient) -> None:
    viewer.send("trundle/request", id="type", request="definition", type="std_msgs/String")
    viewer.until(lambda: any(each.get("id") == "type" for each in viewer.jsons))

    assert viewer.last("trundle/response")["definition"] == "string data\n"
