"""The loop that nodes share leaves nothing open."""

import asyncio
import gc
import socket
import warnings
import weakref
from typing import Any

import pytest
from tests.ros.conftest import PATIENCE_S

from trundle.ros.loop import GraphLoop, close_server


@pytest.mark.parametrize("passes", range(5))
def test_a_server_that_closes_loses_nobody_at_its_door(passes: int) -> None:
    """asyncio makes a transport of an accepted connection one pass later, and forgets it if the server is closed."""

    async def knock() -> None:
        server = await asyncio.start_server(lambda _, writer: writer.close(), "127.0.0.1", 0)
        with socket.create_connection(server.sockets[0].getsockname()) as visitor:
            for _ in range(passes):
                await asyncio.sleep(0)
            await close_server(server)
            visitor.setblocking(False)
            for _ in range(5):
                await asyncio.sleep(0)

    with warnings.catch_warnings(record=True) as leaks:
        warnings.simplefilter("always")
        asyncio.run(knock())
        gc.collect()
    assert [str(leak.message) for leak in leaks] == []


def test_what_a_thread_gathers_comes_when_it_is_released_and_in_order() -> None:
    came: list[int] = []
    with GraphLoop() as loop:
        loop.gather()
        for number in range(3):
            loop.call_soon(lambda number=number: came.append(number))
        assert came == []
        assert loop.rest(5.0, unless=lambda: False)
        assert came == [0, 1, 2]


def test_it_does_not_rest_while_something_is_under_way() -> None:
    with GraphLoop() as loop:
        with loop.work.under_way():
            assert not loop.rest(0.05, unless=lambda: False)
        assert loop.rest(5.0, unless=lambda: False)


def test_a_node_that_has_gone_is_forgotten(graph: Any) -> None:
    """Thousands come and go where every call of a script is a node of its own."""
    node = graph.node("passing")
    node.advertise("/a", "std_msgs/String")
    node.subscribe("/b", "std_msgs/String", print)
    graph.ready(node)
    graph.loop.run(node.shutdown(), PATIENCE_S)
    gone = weakref.ref(node)
    del node

    def is_forgotten() -> bool:
        gc.collect()
        return gone() is None

    graph.until(is_forgotten)
