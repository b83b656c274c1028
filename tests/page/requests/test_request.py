"""Requests of clients reach the owner, and its answers the clients."""

from tests.page_client import ProtocolClient

from trundle.page import MoveJoint, PageServer, Pause, Play, Request, Step


def _requests(page: PageServer, client: ProtocolClient, count: int) -> list[Request]:
    requests: list[Request] = []

    def enough() -> bool:
        requests.extend(page.requests())
        return len(requests) >= count

    client.until(enough)
    return requests


def test_a_request_is_answered_with_its_own_id(page: PageServer) -> None:
    with ProtocolClient(page.url) as client:
        client.send("trundle/request", id=5, request="play")
        client.send("trundle/request", id="b", request="joint", model="arm", joint="elbow", position=0.5)
        first, second = _requests(page, client, 2)
        page.respond(first.id)
        page.respond(second.id, "arm has no joint 'elbow'")
        client.until(lambda: len([m for m in client.jsons if m["op"] == "trundle/response"]) == 2)

    assert (first.action, second.action) == (Play(), MoveJoint(model="arm", joint="elbow", position=0.5))
    assert [m for m in client.jsons if m["op"] == "trundle/response"] == [
        {"op": "trundle/response", "id": 5, "ok": True},
        {"op": "trundle/response", "id": "b", "ok": False, "error": "arm has no joint 'elbow'"},
    ]


def test_requests_of_two_clients_do_not_mix(page: PageServer) -> None:
    with ProtocolClient(page.url) as one, ProtocolClient(page.url) as two:
        one.send("trundle/request", id=1, request="pause")
        (first,) = _requests(page, one, 1)
        two.send("trundle/request", id=1, request="step", count=3)
        (second,) = _requests(page, two, 1)
        page.respond(second.id)
        two.last("trundle/response")
        one.settle()
        page.respond(first.id)
        one.last("trundle/response")

    assert (first.action, second.action) == (Pause(), Step(3))
    assert [len([m for m in c.jsons if m["op"] == "trundle/response"]) for c in (one, two)] == [1, 1]


def test_an_invalid_request_is_refused_at_once(page: PageServer) -> None:
    with ProtocolClient(page.url) as client:
        client.send("trundle/request", id=1, request="step", count=0)
        answer = client.last("trundle/response")

    assert (answer["id"], answer["ok"]) == (1, False)
    assert "count" in answer["error"]
    assert page.requests() == []


def test_the_65th_pending_request_is_refused(page: PageServer) -> None:
    with ProtocolClient(page.url) as client:
        for number in range(65):
            client.send("trundle/request", id=number, request="play")
        assert client.last("trundle/response") == {
            "op": "trundle/response", "id": 64, "ok": False, "error": "64 requests are pending",
        }  # fmt: skip
        assert len(_requests(page, client, 64)) == 64


def test_an_unknown_request_is_refused_with_advice(page: PageServer) -> None:
    with ProtocolClient(page.url) as client:
        client.send("trundle/request", id=1, request="dance")
        assert client.last("trundle/response")["error"] == (
            "unknown request 'dance': the page may be of another version, reload it"
        )
        assert page.requests() == []


def test_the_server_answers_requests_for_definitions(page: PageServer) -> None:
    with ProtocolClient(page.url) as client:
        client.send("trundle/request", id=1, request="definition", type="geometry_msgs/PointStamped")
        assert "MSG: std_msgs/Header" in client.last("trundle/response")["definition"]
        client.send("trundle/request", id=2, request="definition", type="no_msgs/None")
        client.until(lambda: client.last("trundle/response")["id"] == 2)

    assert "no message type 'no_msgs/None'" in client.last("trundle/response")["error"]


def test_other_clients_get_no_channels_of_trundle(page: PageServer) -> None:
    for protocol in ("foxglove.websocket.v1", "foxglove.sdk.v1"):
        with ProtocolClient(page.url, protocol=protocol) as client:
            client.send("trundle/request", id=1, request="play")
            client.until(lambda client=client: client.statuses)
            assert client.socket.subprotocol == protocol
            assert not [topic for topic in client.channels if topic.startswith("trundle/")]
            assert page.requests() == []
