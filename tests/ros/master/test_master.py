"""The master's calls, with their codes and texts."""

import asyncio
import xmlrpc.client
from typing import Any

import pytest

from trundle.ros import Core, MasterError, MasterProxy, MasterUnreachableError, PortTakenError
from trundle.ros.xmlrpc.rpc_server import RpcServer

DEAD = "http://127.0.0.1:9/"


@pytest.fixture
def stdlib(graph: Any) -> Any:
    """The standard library's client, which rospy uses."""
    with xmlrpc.client.ServerProxy(graph.core.uri) as proxy:
        yield proxy


class Listener:
    """XML-RPC interface of a node that records its calls."""

    def __init__(self) -> None:
        self.calls: list[tuple[str, list[Any]]] = []
        self.server = RpcServer(self._record)

    @property
    def uri(self) -> str:
        return f"http://127.0.0.1:{self.server.port}/"

    def _record(self, method: str, arguments: list[Any]) -> Any:
        self.calls.append((method, arguments))
        return 1, "", 0


@pytest.fixture
def listeners(graph: Any) -> Any:
    """Two listeners, started."""
    two = Listener(), Listener()
    for listener in two:
        graph.loop.run(listener.server.start("127.0.0.1", 0))
    yield two
    for listener in two:
        graph.loop.run(listener.server.stop())


def test_registrations_are_answered_as_by_rosmaster(stdlib: Any) -> None:
    assert stdlib.registerPublisher("/a", "/t", "std_msgs/String", DEAD) == [
        1,
        "Registered [/a] as publisher of [/t]",
        [],
    ]
    assert stdlib.registerSubscriber("/b", "/t", "*", DEAD) == [1, "Subscribed to [/t]", [DEAD]]
    assert stdlib.unregisterPublisher("/a", "/t", DEAD) == [1, "Unregistered [/a] as provider of [/t]", 1]
    assert stdlib.unregisterPublisher("/a", "/t", DEAD) == [1, "[/a] is not a registered node", 0]
    assert stdlib.lookupNode("/x", "/nobody") == [-1, "unknown node [/nobody]", ""]
    assert stdlib.lookupService("/x", "/none") == [-1, "no provider", ""]


@pytest.mark.parametrize(
    ("call", "code", "text"),
    [
        (("registerPublisher", "/a", "bad name", "std_msgs/String", DEAD), -1, "contains illegal chars"),
        (("registerPublisher", "/a", "/t", "String", DEAD), -1, "is not a valid package resource name"),
        (("registerPublisher", "/a", "/t", "std_msgs/String", "nowhere"), -1, "is not an RPC URI"),
        (("getSystemState",), -1, "missing required caller_id parameter"),
        (("getSystemState", "/a", 1), -1, "Error: bad call arity"),
        (("getPid", 5), -1, "caller_id must be a string"),
        (("getParam", "/a", "nope"), -1, "Parameter [/nope] is not set"),
        (("deleteParam", "/a", "nope"), -1, "parameter [/nope] is not set"),
        (("searchParam", "/a/b", "nope"), -1, "Cannot find parameter [nope] in an upwards search"),
        (("hasParam", "/a", ""), -1, "must be specified and non-empty"),
        (("setParam", "/a", "/", 3), -1, "cannot set root of parameter tree to non-dictionary"),
        (("setParam", "/a", "/deep" * 1000, 3), -1, "ERROR: parameters nest deeper than 90"),
    ],
)
def test_refusals_have_rosmasters_texts(stdlib: Any, call: tuple[Any, ...], code: int, text: str) -> None:
    method, *arguments = call
    answer = getattr(stdlib, method)(*arguments)
    assert answer[0] == code
    assert text in answer[1]


def test_an_unknown_method_is_a_fault(stdlib: Any) -> None:
    with pytest.raises(xmlrpc.client.Fault, match="not supported"):
        stdlib.doSomething("/a")


def test_a_known_type_replaces_the_type_any(stdlib: Any) -> None:
    stdlib.registerSubscriber("/b", "/t", "*", DEAD)
    assert "/t" not in dict(stdlib.getTopicTypes("/x")[2])
    stdlib.registerPublisher("/a", "/t", "*", DEAD)
    stdlib.registerPublisher("/c", "/t", "std_msgs/String", DEAD)
    assert ["/t", "std_msgs/String"] in stdlib.getPublishedTopics("/x", "")[2]
    assert ["/t", "std_msgs/String"] not in stdlib.getPublishedTopics("/x", "/other")[2]


def test_parameters_resolve_against_the_caller(stdlib: Any) -> None:
    stdlib.setParam("/ns/node", "~gain", 2.5)
    stdlib.setParam("/ns/node", "rate", 10)
    assert stdlib.getParam("/x", "/ns")[2] == {"node": {"gain": 2.5}, "rate": 10}
    assert stdlib.searchParam("/ns/node", "rate") == [1, "Found [/ns/rate]", "/ns/rate"]
    assert {"/ns/node/gain", "/ns/rate"} <= set(stdlib.getParamNames("/x")[2])


@pytest.mark.parametrize("value", [None, [1, None], {"a": {"b": None}}])
def test_a_parameter_that_xml_rpc_cannot_encode_is_refused(graph: Any, value: Any) -> None:
    """It would make its namespaces unreadable, for `rosparam dump` among others."""
    client: Any = xmlrpc.client.ServerProxy(graph.core.uri, allow_none=True)
    with client as proxy:
        code, text, _ = proxy.setParam("/x", "/nothing", value)
        assert (code, text.startswith("ERROR: parameter [value]")) == (-1, True)
        assert proxy.getParam("/x", "/")[0] == 1


def test_a_multicall_returns_all_answers(stdlib: Any) -> None:
    multicall: Any = xmlrpc.client.MultiCall(stdlib)
    multicall.setParam("/x", "/a", 1)
    multicall.getParam("/x", "/a")
    assert list(multicall()) == [[1, "parameter /a set", 0], [1, "Parameter [/a]", 1]]


def test_the_answers_of_a_multicall_are_bounded(graph: Any, stdlib: Any) -> None:
    """Each call of a few bytes requests a long parameter."""
    assert stdlib.setParam("/a", "/long", "x" * 1_000_000)[0] == 1
    multicall = xmlrpc.client.MultiCall(stdlib)
    for _ in range(100):
        multicall.getParam("/a", "/long")
    with pytest.raises(xmlrpc.client.Fault, match="make fewer calls at once"):
        multicall()
    stdlib.deleteParam("/a", "/long")


def test_subscribers_get_publisher_updates_despite_a_dead_one(graph: Any, stdlib: Any, listeners: Any) -> None:
    listener = listeners[0]
    stdlib.registerSubscriber("/dead", "/t", "*", DEAD)
    stdlib.registerSubscriber("/alive", "/t", "*", listener.uri)
    stdlib.registerPublisher("/a", "/t", "std_msgs/String", "http://127.0.0.1:1/")
    graph.until(lambda: listener.calls)
    assert listener.calls[0] == ("publisherUpdate", ["/master", "/t", ["http://127.0.0.1:1/"]])
    stdlib.unregisterPublisher("/a", "/t", "http://127.0.0.1:1/")
    graph.until(lambda: len(listener.calls) > 1)
    assert listener.calls[1] == ("publisherUpdate", ["/master", "/t", []])


def test_subscribers_of_a_parameter_get_updates_except_the_setter(graph: Any, stdlib: Any, listeners: Any) -> None:
    first, second = listeners
    assert stdlib.subscribeParam("/one", first.uri, "/a") == [1, "Subscribed to parameter [/a]", {}]
    stdlib.subscribeParam("/two", second.uri, "/a/b")
    stdlib.setParam("/one", "/a", {"b": 3})
    graph.until(lambda: second.calls)
    assert second.calls == [("paramUpdate", ["/master", "/a/b/", 3])]
    stdlib.deleteParam("/x", "/a")
    graph.until(lambda: first.calls)
    assert first.calls == [("paramUpdate", ["/master", "/a/", {}])]


def test_the_setter_of_a_namespace_gets_updates_of_subscribed_parts(graph: Any, stdlib: Any, listeners: Any) -> None:
    """As in rosmaster: a node that caches a part would otherwise keep its old value."""
    listener = listeners[0]
    stdlib.subscribeParam("/one", listener.uri, "/a/b")
    stdlib.subscribeParam("/one", listener.uri, "/a/c")
    stdlib.setParam("/one", "/a/c", 1)
    stdlib.setParam("/one", "/a", {"b": 3})
    graph.until(lambda: len(listener.calls) > 1)
    assert listener.calls == [("paramUpdate", ["/master", "/a/b/", 3]), ("paramUpdate", ["/master", "/a/c/", {}])]


def test_an_older_node_of_the_same_name_is_shut_down(graph: Any, stdlib: Any, listeners: Any) -> None:
    older = listeners[0]
    stdlib.registerPublisher("/twin", "/t", "std_msgs/String", older.uri)
    stdlib.registerSubscriber("/twin", "/u", "std_msgs/String", DEAD)
    graph.until(lambda: older.calls)
    assert older.calls == [("shutdown", ["/master", "[/twin] Reason: new node registered with same name"])]
    state = stdlib.getSystemState("/x")[2]
    assert ["/t", ["/twin"]] not in state[0]
    assert ["/u", ["/twin"]] in state[1]


def test_core_sets_the_parameters_of_roscore(graph: Any) -> None:
    proxy = MasterProxy(graph.core.uri)
    assert proxy.call("getParam", "/rosdistro") == "noetic\n"
    assert proxy.call("getParam", "/run_id") == graph.core.run_id
    assert proxy.call("getSystemState")[0] == [["/rosout_agg", ["/rosout"]]]


def test_the_master_answers_at_localhost(graph: Any) -> None:
    assert MasterProxy(f"http://localhost:{graph.core.port}").call("getPid") > 0


def test_a_taken_port_is_reported_with_the_option_to_change_it(graph: Any) -> None:
    with pytest.raises(PortTakenError, match=f"port {graph.core.port} on 127.0.0.1 is taken.*-p PORT"):
        graph.loop.run(Core(graph.loop, port=graph.core.port).start())


def test_the_blocking_proxy_names_the_master_that_does_not_answer(graph: Any) -> None:
    with pytest.raises(MasterUnreachableError, match=r"no ROS master answers at http://127.0.0.1:9/.*trundle core"):
        MasterProxy(DEAD).call("getPid")
    with pytest.raises(MasterUnreachableError, match="http://localhost:11311"):
        MasterProxy("nonsense").call("getPid")
    with pytest.raises(MasterError, match="is not set"):
        MasterProxy(graph.core.uri).call("getParam", "/nope")


def test_a_connection_serves_several_calls(graph: Any) -> None:
    async def two_calls() -> list[bytes]:
        reader, writer = await asyncio.open_connection("127.0.0.1", graph.core.port)
        body = xmlrpc.client.dumps(("/x",), "getPid").encode()
        answers: list[bytes] = []
        for version in (b"1.1", b"1.0"):
            writer.write(b"POST /RPC2 HTTP/%b\r\nContent-Length: %d\r\n\r\n%b" % (version, len(body), body))
            head = await reader.readuntil(b"\r\n\r\n")
            size = int(head.lower().partition(b"content-length: ")[2].partition(b"\r")[0])
            answers.append(await reader.readexactly(size))
        assert await reader.read() == b""  # HTTP/1.0 ends the connection
        writer.close()
        return answers

    first, second = graph.loop.run(two_calls(), 20)
    assert first == second
