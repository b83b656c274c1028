"""Calls wait for a peer that is suspended or overloaded, and fail at once when it ends."""

import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Generator
from contextlib import contextmanager

import psutil
import pytest
from tests.graphs import PATIENCE_S, until

from trundle.ros import Core, GraphLoop, MasterProxy, MasterUnreachableError, Node, ServiceError

_STOP_S = 7.0
"""Longer than usual timeouts of calls between nodes [s]."""
_CORE = """
import time
from trundle.ros import Core, GraphLoop
with GraphLoop() as loop:
    core = Core(loop, port=0)
    loop.run(core.start())
    print(core.uri, flush=True)
    time.sleep(1000)
"""
_PEER = """
import sys
from trundle.ros import GraphLoop, Node
with GraphLoop() as loop:
    node = Node("peer", loop=loop, master_uri=sys.argv[1])
    node.advertise_service("/theirs", "std_srvs/Trigger", lambda request: {"success": True})
    node.subscribe("/late", "std_msgs/String", lambda message: print(message.data, flush=True))
    loop.run(node.wait_registered())
    print("ready", flush=True)
    input()
"""
pytestmark = pytest.mark.skipif(not hasattr(signal, "SIGSTOP"), reason="Windows stops no process")


@contextmanager
def _process(source: str, *words: str) -> Generator[tuple["subprocess.Popen[str]", str]]:
    """Run a program; yield the process and the first line of its output."""
    command = [sys.executable, "-c", source, *words]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout is not None
            yield process, process.stdout.readline().strip()
        finally:
            process.kill()


def _stop_for_a_while(process: "subprocess.Popen[str]") -> threading.Timer:
    """Stop a process, and continue it after `_STOP_S`."""
    process.send_signal(signal.SIGSTOP)
    timer = threading.Timer(_STOP_S, lambda: os.kill(process.pid, signal.SIGCONT))
    timer.start()
    return timer


def test_calls_wait_for_a_stopped_master(capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    for module in ("base.waiting", "ros.node.pending_work", "ros.xmlrpc.proxy"):
        monkeypatch.setattr(f"trundle.{module}.PERIOD_S", 1.0)
    with _process(_CORE) as (process, uri), GraphLoop() as loop:
        node = Node("n", loop=loop, master_uri=uri)
        loop.run(node.wait_registered(), PATIENCE_S)
        timer = _stop_for_a_while(process)
        blocking = threading.Thread(target=lambda: answers.append(MasterProxy(uri).call("getPid")))
        answers: list[int] = []
        blocking.start()

        run_id = loop.run(node.params.get("/run_id"), PATIENCE_S)

        assert len(str(run_id)) == 36
        blocking.join(PATIENCE_S)
        assert answers == [process.pid]
        timer.join()
        loop.run(node.shutdown(), PATIENCE_S)
    output = capfd.readouterr().err
    assert f"waiting for the answer of the ROS master at {uri} to getParam since " in output
    assert f"waiting for the answer of {uri} to getPid since " in output


def test_a_call_fails_at_once_when_the_master_ends() -> None:
    with _process(_CORE) as (process, uri), GraphLoop() as loop:
        node = Node("n", loop=loop, master_uri=uri)
        loop.run(node.wait_registered(), PATIENCE_S)
        process.send_signal(signal.SIGSTOP)
        threading.Timer(0.5, process.kill).start()
        with pytest.raises(MasterUnreachableError):
            loop.run(node.params.get("/run_id"), PATIENCE_S)


def test_a_stopped_node_gets_its_calls_and_messages_later() -> None:
    """Both the master's update and the request reach it late."""
    with GraphLoop() as loop:
        core = Core(loop, port=0)
        loop.run(core.start(), PATIENCE_S)
        node = Node("n", loop=loop, master_uri=core.uri)
        with _process(_PEER, core.uri) as (process, _):
            timer = _stop_for_a_while(process)
            publisher = node.advertise("/late", "std_msgs/String", latch=True)
            publisher.publish({"data": "heard"})

            answer = loop.run(node.call_service("/theirs", "std_srvs/Trigger"), PATIENCE_S)

            assert answer.success
            assert process.stdout is not None
            assert process.stdout.readline() == "heard\n"
            timer.join()


def test_a_call_fails_at_once_when_the_node_ends() -> None:
    with GraphLoop() as loop:
        core = Core(loop, port=0)
        loop.run(core.start(), PATIENCE_S)
        node = Node("n", loop=loop, master_uri=core.uri)
        with _process(_PEER, core.uri) as (process, _):
            process.send_signal(signal.SIGSTOP)
            until(lambda: psutil.Process(process.pid).status() == psutil.STATUS_STOPPED)
            threading.Timer(0.5, process.kill).start()
            with pytest.raises(ServiceError):
                loop.run(node.call_service("/theirs", "std_srvs/Trigger"), PATIENCE_S)


def test_a_stopping_loop_waits_for_a_slow_callback(
    capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("trundle.base.waiting.PERIOD_S", 0.2)
    ended: list[bool] = []

    def block() -> None:
        time.sleep(3.0)
        ended.append(True)

    with GraphLoop() as loop:
        loop.call_soon(block)
    assert ended == [True]
    assert "waiting for the nodes of this process to shut down since " in capfd.readouterr().err
