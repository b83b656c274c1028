"""Every call, with valid and invalid arguments, has the same answer from Debian's rosmaster and from our master."""

import socket
import subprocess
import xmlrpc.client
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.graphs import PATIENCE_S, until

from trundle.ros import Core, GraphLoop, MasterProxy, MasterUnreachableError, Messages

pytestmark = [
    pytest.mark.real_ros,
    pytest.mark.skipif(not Path("/usr/bin/rosmaster").exists(), reason="Debian's rosmaster is not installed"),
]
STRING = "std_msgs/String"
ONE, TWO = "http://127.0.0.1:9/", "http://127.0.0.1:10/"
RPC, OTHER_RPC = "rosrpc://127.0.0.1:9", "rosrpc://127.0.0.1:11"
NAMES = ["", "/", "~x", "a b", "/a//b", "1x", "/t", "t", 5, True, [], {"a": 1}, 1.5]
VALUES = [1, -5, 2**31 - 1, 1.5, True, "x", "", [1, [2, "y"]], {}, {"a": {"b": 1}, "c": []}]
APIS = ["", "foo", "http://", "http://x", "rosrpc://x:1", 5, ONE]
TYPES = ["", "*", STRING, "String", 5, "a/b/c"]
METHODS = (
    *("getUri", "getParam", "setParam", "hasParam", "deleteParam", "searchParam", "getParamNames", "subscribeParam"),
    *("getSystemState", "getTopicTypes", "getPublishedTopics", "lookupNode", "lookupService", "nope"),
    *("registerPublisher", "registerSubscriber", "registerService"),
    *("unregisterPublisher", "unregisterSubscriber", "unregisterService", "unsubscribeParam"),
)
Call = tuple[Any, ...]


def _name_calls() -> Iterator[Call]:
    for caller in ("/me", "me", "~me", "", "a b", 5):
        yield from (("getParam", caller, "/nope"), ("getUri", caller), ("lookupNode", caller, "/nobody"))
        yield from (("registerPublisher", caller, "/t9", STRING, ONE), ("unregisterPublisher", caller, "/t9", ONE))
    for name in NAMES:
        yield from (("setParam", "/me", name, 1), ("getParam", "/me", name), ("hasParam", "/me", name))
        yield from (("searchParam", "/me", name), ("searchParam", "me", name), ("deleteParam", "/me", name))
        yield from (("subscribeParam", "/me", ONE, name), ("unsubscribeParam", "/me", ONE, name))
        yield from (("registerPublisher", "/p", name, STRING, ONE), ("unregisterPublisher", "/p", name, ONE))
        yield from (("registerSubscriber", "/s", name, "*", ONE), ("unregisterSubscriber", "/s", name, ONE))
        yield from (("registerService", "/p", name, RPC, ONE), ("lookupService", "/p", name))
        yield from (("unregisterService", "/p", name, RPC), ("lookupNode", "/p", name))
        yield ("getPublishedTopics", "/p", name)


def _type_and_address_calls() -> Iterator[Call]:
    for kind in TYPES:
        yield from (("registerPublisher", "/p", "/ty", kind, ONE), ("registerSubscriber", "/s", "/ty", kind, ONE))
        yield from (("getTopicTypes", "/x"), ("getPublishedTopics", "/x", ""))
        yield from (("unregisterPublisher", "/p", "/ty", ONE), ("unregisterSubscriber", "/s", "/ty", ONE))
    for api in APIS:
        yield from (("registerPublisher", "/p", "/u", STRING, api), ("unregisterPublisher", "/p", "/u", api))
        yield from (("registerSubscriber", "/s", "/u", "*", api), ("unregisterSubscriber", "/s", "/u", api))
        yield from (("registerService", "/p", "/one", api, ONE), ("unregisterService", "/p", "/one", api))
        yield from (("registerService", "/p", "/two", RPC, api), ("unregisterService", "/p", "/two", RPC))
        yield ("subscribeParam", "/me", api, "/q")


def _parameter_calls() -> Iterator[Call]:
    for value in VALUES:
        yield from (("setParam", "/me", "/v", value), ("getParam", "/me", "/v"), ("getParam", "/me", "/v/a/b"))
        yield from (("hasParam", "/me", "/v/a"), ("getParamNames", "/me"), ("setParam", "/me", "/v/z", 3))
        yield from (("getParam", "/me", "/v"), ("deleteParam", "/me", "/v"), ("deleteParam", "/me", "/v"))
    yield from (("setParam", "/ns/node", "~p", 1), ("getParam", "/ns/node", "~p"), ("setParam", "/ns/node", "rel", 2))
    yield from (("getParam", "/", "/"), ("searchParam", "/ns/node/deep", "rel"), ("searchParam", "/ns/node", "p"))
    yield from (("searchParam", "/ns/node", "rel/x"), ("searchParam", "/ns/node", "nope"))
    yield from (("setParam", "/me", "/", {"all": 1}), ("getParam", "/me", "/all"), ("setParam", "/me", "/", 5))
    yield from (("deleteParam", "/me", "/"), ("hasParam", "/me", "/"))


def _registration_calls() -> Iterator[Call]:
    yield from [("registerPublisher", "/a", "/t", STRING, ONE)] * 2
    yield from (("registerPublisher", "/b", "/t", "std_msgs/Int32", TWO), ("getTopicTypes", "/x"))
    yield from (("registerSubscriber", "/s", "/t", "std_msgs/Float32", ONE), ("getTopicTypes", "/x"))
    yield from (("getPublishedTopics", "/x", graph) for graph in ("", "/", "/n", "t"))
    yield from (("getSystemState", "/x"), ("lookupNode", "/x", "/a"), ("lookupNode", "/x", "a"))
    yield from (("registerPublisher", "/a", "/t", STRING, TWO), ("getSystemState", "/x"), ("lookupNode", "/x", "/a"))
    yield from (("unregisterPublisher", node, "/t", api) for node in ("/a", "/zz") for api in (ONE, TWO))
    yield from (("unregisterSubscriber", "/s", "/none", ONE), ("registerService", "/a", "/srv", RPC, ONE))
    yield from (("registerService", "/b", "/srv", OTHER_RPC, TWO), ("lookupService", "/x", "/srv"))
    yield from (("unregisterService", "/a", "/srv", RPC), ("unregisterService", "/b", "/srv", OTHER_RPC))
    yield ("getSystemState", "/x")
    for method in METHODS:
        yield from ((method,), (method, *range(8)), (method, "/x", "extra", "more", "than", "that"))


@pytest.fixture
def rosmaster(tmp_path: Path) -> Iterator[str]:
    """URI of a running rosmaster of Debian."""
    with socket.create_server(("127.0.0.1", 0)) as probe:
        port = probe.getsockname()[1]
    uri = f"http://127.0.0.1:{port}"
    environment = {"PATH": "/usr/bin:/bin", "HOME": str(tmp_path), "ROS_MASTER_URI": uri, "ROS_IP": "127.0.0.1"}
    command, null = ["/usr/bin/rosmaster", "--core", "-p", str(port)], subprocess.DEVNULL
    with subprocess.Popen(command, env=environment, stdout=null, stderr=null) as process:
        try:
            yield uri
        finally:
            process.kill()


def _answer(master: Any, method: str, *arguments: Any) -> Any:
    """Answer of a master, without its own address; unordered lists are sorted."""
    try:
        answer = getattr(master, method)(*arguments)
    except xmlrpc.client.Fault as fault:
        return "fault", fault.faultCode
    if method == "getUri" and answer[0] == 1:
        return answer[:2]
    if isinstance(answer[2], list):
        answer[2] = sorted(map(repr, answer[2]))
    return answer


def test_every_answer_matches_rosmaster(rosmaster: str, messages: Messages) -> None:
    def is_up() -> bool:
        try:
            return MasterProxy(rosmaster).call("getPid") > 0
        except MasterUnreachableError:
            return False

    until(is_up)
    different: list[Any] = []
    with GraphLoop(messages=messages) as loop:
        core = Core(loop, port=0, rosout=False)
        loop.run(core.start(), PATIENCE_S)
        clients: list[Any] = [xmlrpc.client.ServerProxy(uri) for uri in (rosmaster, core.uri)]
        with clients[0] as debians, clients[1] as ours:
            for master in (debians, ours):
                for name in master.getParamNames("/x")[2]:
                    master.deleteParam("/x", name)
            for part in (_name_calls, _type_and_address_calls, _parameter_calls, _registration_calls):
                for call in part():
                    answers = _answer(debians, *call), _answer(ours, *call)
                    if answers[0] != answers[1]:
                        different.append((call, *answers))
        loop.run(core.stop(), PATIENCE_S)
    assert different == []
