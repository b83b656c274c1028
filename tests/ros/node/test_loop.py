"""The loop that nodes share: batches, waits, and a shutdown that leaves nothing open."""

import asyncio
import ctypes
import gc
import os
import platform
import signal
import socket
import struct
import subprocess
import sys
import threading
import time
import warnings
import weakref
from typing import Any

import pytest
from tests.ros.conftest import PATIENCE_S

from trundle.base.diagnostics import UsageError
from trundle.ros.node.graph_node import Node
from trundle.ros.node.loop import GraphLoop
from trundle.ros.transport.closing_loop import close_server


@pytest.mark.parametrize("passes", range(5))
def test_closing_a_server_closes_connections_it_just_accepted(passes: int) -> None:
    """asyncio creates an accepted connection's transport one pass later, and leaks it if the server is closed."""

    async def close_after_accepting() -> None:
        server = await asyncio.start_server(lambda _, writer: writer.close(), "127.0.0.1", 0)
        with socket.create_connection(server.sockets[0].getsockname()) as client:
            for _ in range(passes):
                await asyncio.sleep(0)
            await close_server(server)
            client.setblocking(False)
            for _ in range(5):
                await asyncio.sleep(0)

    with warnings.catch_warnings(record=True) as leaks:
        warnings.simplefilter("always")
        asyncio.run(close_after_accepting())
        gc.collect()
    assert [str(leak.message) for leak in leaks] == []


def test_batched_calls_run_in_order_when_the_batch_ends() -> None:
    called: list[int] = []
    with GraphLoop() as loop:
        loop.begin_batch()
        for number in range(3):
            loop.call_soon(lambda number=number: called.append(number))
        assert called == []
        assert loop.wait_idle()
        assert called == [0, 1, 2]


def test_the_loop_is_not_idle_while_work_is_pending() -> None:
    with GraphLoop() as loop:
        due_s = time.monotonic() + 0.05
        with loop.work.pending():
            assert not loop.wait_idle(unless=lambda: time.monotonic() > due_s)
        assert loop.wait_idle()


def test_a_shut_down_node_is_freed(graph: Any) -> None:
    """Scripts that create a node per call start and shut down thousands."""
    node = graph.node("passing")
    node.advertise("/a", "std_msgs/String")
    node.subscribe("/b", "std_msgs/String", print)
    graph.ready(node)
    graph.loop.run(node.shutdown(), PATIENCE_S)
    reference = weakref.ref(node)
    del node

    def is_freed() -> bool:
        gc.collect()
        return reference() is None

    graph.until(is_freed)


def test_tasks_created_while_the_loop_stops_are_cancelled_too(caplog: pytest.LogCaptureFixture) -> None:
    """Each cancelled task starts another one, as a peer's last call does."""
    ended: list[int] = []

    async def outlive(generation: int) -> None:
        try:
            await asyncio.sleep(1000)
        finally:
            if generation < 3:
                tasks.append(asyncio.ensure_future(outlive(generation + 1)))
                await asyncio.sleep(0)
            ended.append(generation)

    tasks: list[asyncio.Future[None]] = []
    with GraphLoop() as loop:
        loop.spawn(outlive(0))
        loop.flush_deliveries()
    tasks.clear()
    gc.collect()
    assert ended == [0, 1, 2, 3]
    assert "pending" not in caplog.text


def test_nodes_created_while_the_loop_stops_leave_no_task(graph: Any, caplog: pytest.LogCaptureFixture) -> None:
    """Nodes that a thread keeps creating are neither started nor awaited."""
    loop, over = GraphLoop(messages=graph.loop.messages), threading.Event()
    loop.start()

    def feed() -> None:
        for number in range(2000):
            if over.is_set():
                return
            node = Node(f"late{number}", loop=loop, master_uri=graph.core.uri)
            node.subscribe("/a", "std_msgs/String", print)
            loop.spawn(node.wait_registered())

    feeder = threading.Thread(target=feed)
    feeder.start()
    while len(loop.local.members) < 3:
        time.sleep(0.001)
    loop.stop()
    over.set()
    feeder.join()
    gc.collect()
    assert "pending" not in caplog.text
    assert "cannot go on" not in caplog.text


def test_a_coroutine_spawned_on_a_stopped_loop_is_cancelled() -> None:
    with GraphLoop() as loop:
        pass
    assert loop.spawn(asyncio.sleep(0)).cancelled()


@pytest.mark.parametrize(("error", "is_logged"), [(UsageError("no such file"), False), (KeyError("a"), True)])
def test_only_program_errors_are_logged_with_a_traceback(
    error: Exception, is_logged: bool, caplog: pytest.LogCaptureFixture
) -> None:
    async def fail() -> None:
        raise error

    loop = GraphLoop()
    loop.start()
    try:
        with pytest.raises(type(error)):
            loop.spawn(fail()).result(PATIENCE_S)
    finally:
        loop.stop()

    assert ("a task of the graph failed" in caplog.text) is is_logged


_SCHED_GETATTR = {"x86_64": 315, "aarch64": 275, "riscv64": 275}
"""Linux' number of the call."""


def _slice_ns(thread: int) -> int:
    """Time slice of a thread of this process, from the kernel [ns]."""
    number = _SCHED_GETATTR.get(platform.machine()) if platform.system() == "Linux" else None
    if number is None:
        pytest.skip(f"no time slices are known of {platform.system()} on {platform.machine()}")
    answer = ctypes.create_string_buffer(48)
    if ctypes.CDLL(None, use_errno=True).syscall(number, thread, answer, len(answer), 0) != 0:
        pytest.skip(f"sched_getattr: {os.strerror(ctypes.get_errno())}")
    *_, runtime_ns, _, _ = struct.unpack("<IIQiIQQQ", answer.raw)
    if runtime_ns == 0:
        pytest.skip(f"Linux {platform.release()} reports no slices; 6.12 does")
    return runtime_ns


def test_only_the_loops_thread_has_a_short_time_slice() -> None:
    """A message is read at once on a busy machine; computing threads are not interrupted every 0.1 ms."""
    if os.getpriority(os.PRIO_PROCESS, 0) != 0:
        pytest.skip("these tests run at a priority of their user's, which the loop leaves alone")
    default_ns = _slice_ns(threading.get_native_id())

    async def slices() -> tuple[int, int]:
        loop_ns = _slice_ns(threading.get_native_id())
        return loop_ns, await asyncio.to_thread(lambda: _slice_ns(threading.get_native_id()))

    with GraphLoop() as loop:
        assert loop.run(slices()) == (100_000, default_ns)
    assert _slice_ns(threading.get_native_id()) == default_ns != 100_000


_WAITS = """
import asyncio, signal, threading, time
from trundle.ros import GraphLoop

def signal_me():
    time.sleep(0.5)
    signal.pthread_kill(threading.get_ident(), signal.SIGINT)

with GraphLoop() as loop:
    threading.Thread(target=signal_me).start()
    try:
        loop.run(asyncio.sleep(60.0), None)
    except KeyboardInterrupt:
        print("interrupted")
"""


@pytest.mark.skipif(not hasattr(signal, "pthread_kill"), reason="Windows sends no signal to a thread")
def test_an_interrupt_delivered_to_another_thread_ends_the_wait() -> None:
    """Linux may give a process' signal to any of its threads; it wakes only that one."""
    done = subprocess.run([sys.executable, "-c", _WAITS], capture_output=True, text=True, timeout=PATIENCE_S)

    assert done.stdout == "interrupted\n"


def test_a_wait_longer_than_the_poll_interval_returns_or_times_out() -> None:
    with GraphLoop() as loop:
        assert loop.run(asyncio.sleep(1.2, "slept"), None) == "slept"
        with pytest.raises(TimeoutError):
            loop.run(asyncio.sleep(60.0), 0.7)
        with pytest.raises(TimeoutError, match="own timeout"):
            loop.run(_late_error(), None)


async def _late_error() -> None:
    await asyncio.sleep(0.6)
    raise TimeoutError("own timeout")


def test_a_cancelled_shutdown_lets_the_loop_stop(graph: Any) -> None:
    node = graph.node("n")
    graph.ready(node)

    async def cancel_shutdown() -> None:
        shutdown = asyncio.ensure_future(node.shutdown())
        await asyncio.sleep(0)
        shutdown.cancel()
        await asyncio.gather(shutdown, return_exceptions=True)

    graph.loop.run(cancel_shutdown(), PATIENCE_S)
    assert node.closed.is_set()
