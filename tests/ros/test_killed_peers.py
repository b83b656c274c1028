"""SIGKILL of a peer that subscribes, serves, calls, watches a parameter, waits for an action or records."""

import asyncio
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from tests.ros.conftest import PATIENCE_S

from trundle.ros import ActionResult, ActionServer, MasterProxy, ServiceError

STRING = "std_msgs/String"
EMPTY = "std_srvs/Empty"
_RETRIES_S = 2.0
"""Time in which a subscriber tries several times to reach a publisher again."""
PEER = """
import asyncio, sys
from trundle.ros import GraphLoop, MasterProxy, Node

async def never(request):
    await asyncio.Event().wait()

with GraphLoop() as loop:
    node = Node("peer", loop=loop, master_uri=sys.argv[1])
    match sys.argv[2]:
        case "subscriber":
            node.subscribe("/a", "std_msgs/String", lambda message: None)
        case "publisher":
            node.advertise("/a", "std_msgs/String", latch=True).publish({"data": "hello"})
        case "service":
            node.advertise_service("/theirs", "std_srvs/Empty", never)
        case "client":
            loop.spawn(node.call_service("/ours", "std_srvs/Empty"))
        case "parameter":
            loop.run(node.wait_registered())
            loop.run(node.params.watch("/p", lambda *_: None))
            loop.run(node.params.set("/watched", True))
        case "action":
            goals = node.advertise("/do/goal", "actionlib_tutorials/FibonacciActionGoal", latch=True)
            goals.publish({"goal": {"order": 3}})
        case "master":
            while True:
                MasterProxy(sys.argv[1]).call("setParam", "/busy", ["x" * 1000] * 100)
    loop.run(node.wait_registered())
    input()
"""


@contextmanager
def _killed(graph: Any, *words: str) -> Iterator[None]:
    """Run a process, and kill it at the end of the block."""
    env = {**os.environ, "ROS_MASTER_URI": graph.core.uri}
    pipes: dict[str, Any] = {"stdin": subprocess.PIPE, "stdout": subprocess.DEVNULL}
    with subprocess.Popen([sys.executable, *words], env=env, **pipes) as process:
        try:
            yield
        finally:
            process.send_signal(signal.SIGKILL)


def _peer(graph: Any, role: str) -> Any:
    return _killed(graph, "-c", PEER, graph.core.uri, role)


def _check_works(graph: Any, node: Any) -> None:
    """Check that topics, services and parameters of a node still work for others."""
    got: list[str] = []
    publisher = node.advertise("/still", STRING)
    other = graph.node("other")
    subscription = other.subscribe("/still", STRING, lambda message: got.append(message.data))
    graph.until(lambda: subscription.publishers)
    publisher.publish({"data": "yes"})
    graph.until(lambda: got == ["yes"])
    node.advertise_service("/still/there", EMPTY, lambda _: None)
    graph.loop.run(other.wait_for_service("/still/there", PATIENCE_S), PATIENCE_S)
    graph.loop.run(other.call_service("/still/there", EMPTY), PATIENCE_S)
    graph.loop.run(other.params.set("/still", 1), PATIENCE_S)


def test_a_killed_subscriber_is_disconnected(graph: Any) -> None:
    node = graph.node("n")
    publisher = node.advertise("/a", STRING, queue_size=3)
    with _peer(graph, "subscriber"):
        graph.until(lambda: publisher.subscribers)
    for number in range(10):
        publisher.publish({"data": str(number) * 100_000})
    graph.until(lambda: publisher.subscribers == 0)
    _check_works(graph, node)


def test_a_killed_publisher_causes_no_warning(graph: Any, capfd: pytest.CaptureFixture[str]) -> None:
    """It is still registered, but nothing listens at its address: it has ended, and the network works."""
    received: list[Any] = []
    graph.node("n").subscribe("/a", STRING, received.append)
    with _peer(graph, "publisher"):
        graph.until(lambda: received)
    time.sleep(_RETRIES_S)
    assert "no messages on /a" not in capfd.readouterr().err


def test_a_killed_service_fails_the_call(graph: Any) -> None:
    node = graph.node("n")
    with _peer(graph, "service"):
        graph.loop.run(node.wait_for_service("/theirs", PATIENCE_S), PATIENCE_S)
        answer = graph.loop.spawn(node.call_service("/theirs", EMPTY))
    with pytest.raises(ServiceError, match="/theirs"):
        answer.result(PATIENCE_S)
    _check_works(graph, node)


def test_a_client_killed_during_a_call_does_not_block_the_service(graph: Any) -> None:
    node, calls, may_answer = graph.node("n"), list[int](), asyncio.Event()

    async def answer(_: object) -> None:
        calls.append(1)
        await may_answer.wait()

    service = node.advertise_service("/ours", EMPTY, answer)
    graph.ready(node)
    with _peer(graph, "client"):
        graph.until(lambda: calls)
    graph.loop.call_soon(may_answer.set)
    graph.loop.run(graph.node("next").call_service("/ours", EMPTY), PATIENCE_S)
    assert len(calls) == 2
    service.unregister()
    _check_works(graph, node)


def test_a_killed_watcher_does_not_block_parameter_updates(graph: Any) -> None:
    """The master continues to set the parameter; another node may watch it."""
    node = graph.node("n")
    values: list[object] = []
    graph.loop.run(node.params.set("/p", 0), PATIENCE_S)
    with _peer(graph, "parameter"):
        graph.until(lambda: MasterProxy(graph.core.uri).call("hasParam", "/watched"))
    graph.ready(node)
    graph.loop.run(node.params.watch("/p", lambda _, value: values.append(value)), PATIENCE_S)
    for number in range(1, 4):
        graph.loop.run(graph.node("setter").params.set("/p", number), PATIENCE_S)
        graph.until(lambda number=number: values and values[-1] == number)
    _check_works(graph, node)


def test_a_killed_action_client_does_not_block_the_server(graph: Any) -> None:
    node, goals, may_end = graph.node("n"), list[int](), asyncio.Event()

    async def work(goal: Any, accept: Callable[[], None]) -> ActionResult:
        accept()
        goals.append(goal.order)
        await may_end.wait()
        return ActionResult(result={"sequence": [0, 1, 1]})

    results: list[Any] = []
    ActionServer(node, "/do", "actionlib_tutorials/Fibonacci", work)
    graph.ready(node)
    listener = graph.node("listener").subscribe(
        "/do/result", "actionlib_tutorials/FibonacciActionResult", results.append
    )
    graph.until(lambda: listener.publishers)
    with _peer(graph, "action"):
        graph.until(lambda: goals == [3])
    graph.loop.call_soon(may_end.set)
    graph.until(lambda: results)
    assert list(results[0].result.sequence) == [0, 1, 1]
    _check_works(graph, node)


def test_a_peer_killed_during_a_call_does_not_block_the_master(graph: Any) -> None:
    node = graph.node("n")
    proxy = MasterProxy(graph.core.uri)
    with _peer(graph, "master"):
        graph.until(lambda: proxy.call("hasParam", "/busy"))
    _check_works(graph, node)


def test_a_killed_recorder_does_not_block_publishers(graph: Any, tmp_path: Path) -> None:
    """tests/app/cli/bag/test_bag.py tests the bag written until then."""
    node = graph.node("n")
    publisher = node.advertise("/a", STRING, queue_size=None)
    with _killed(graph, "-m", "trundle", "bag", "record", "-q", "-O", str(tmp_path / "x.bag"), "/a"):
        graph.until(lambda: publisher.subscribers)
        for _ in range(100):
            publisher.publish({"data": "x" * 100_000})
    graph.until(lambda: publisher.subscribers == 0)
    _check_works(graph, node)
