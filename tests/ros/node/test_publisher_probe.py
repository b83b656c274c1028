"""Probe of a publisher, and service calls with serialized requests."""

import pytest
from tests.graphs import Graph

from trundle.ros import MessageError, RosError, ServiceError, call_service_bytes, probe_publisher


def test_a_probe_returns_the_type_and_definition_of_a_topic(graph: Graph) -> None:
    talker, asker = graph.node("talker"), graph.node("asker")
    talker.advertise("/strange", "no_msgs/Thing", raw_type=("0" * 32, "uint8 a\n"))
    graph.ready(talker, asker)

    header = graph.loop.run(probe_publisher(asker, "/talker", "/strange"))

    assert (header["type"], header["md5sum"]) == ("no_msgs/Thing", "0" * 32)
    assert header["message_definition"] == "uint8 a\n"
    with pytest.raises(MessageError):
        asker.messages.definition("no_msgs/Thing")


@pytest.mark.parametrize("pair", [("/nobody", "/strange"), ("/asker", "/nothing")])
def test_probing_an_unknown_node_or_topic_raises(graph: Graph, pair: tuple[str, str]) -> None:
    asker = graph.node("asker")
    asker.advertise("/chat", "std_msgs/String")
    graph.ready(asker)

    with pytest.raises(RosError, match=f"{pair[0]} does not describe {pair[1]}:"):
        graph.loop.run(probe_publisher(asker, *pair))


def test_a_service_is_called_with_bytes(graph: Graph) -> None:
    def handler(request: object) -> dict[str, object]:
        if not request.data:  # pyright: ignore[reportAttributeAccessIssue]
            raise ServiceError("not now")
        return {"success": True, "message": "ok"}

    server, caller = graph.node("server"), graph.node("caller")
    server.advertise_service("/enable", "std_srvs/SetBool", handler)
    graph.ready(server, caller)
    kind = caller.messages.service("std_srvs/SetBool")

    def call(name: str, body: bytes) -> bytes:
        return graph.loop.run(call_service_bytes(caller, name, kind, body))

    assert call("/enable", b"\1") == b"\1\2\0\0\0ok"
    with pytest.raises(ServiceError, match="not now"):
        call("/enable", b"\0")
    with pytest.raises(ServiceError, match="no node provides the service /none"):
        call("/none", b"")
