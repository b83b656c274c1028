"""The loop that nodes share leaves nothing open."""

import asyncio
import gc
import socket
import warnings

import pytest

from trundle.ros.loop import close_server


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
