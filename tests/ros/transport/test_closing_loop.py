"""Servers of a process with a low limit of open files."""

import os
import socket
import subprocess
import sys
import textwrap
import time
from collections.abc import Generator
from contextlib import contextmanager, suppress

import pytest

pytestmark = pytest.mark.skipif(os.name != "posix", reason="ulimit needs a POSIX shell")

_MAX_FILES = 30
_SERVER = """
    import asyncio, sys
    from trundle.ros.transport.closing_loop import ClosingLoop, close_server
    from trundle.ros.transport.fast_selector import FastSelector

    class Greet(asyncio.Protocol):
        def connection_made(self, transport):
            transport.write(b"hello")

    async def serve():
        server = await loop.create_server(Greet, "127.0.0.1", 0, backlog=64)
        print(server.sockets[0].getsockname()[1], flush=True)
        await loop.run_in_executor(None, sys.stdin.readline)
        await close_server(server)
        await asyncio.sleep(1.5)  # asyncio tries again

    loop = ClosingLoop(FastSelector())
    loop.run_until_complete(serve())
    loop.run_until_complete(loop.close_all())
    loop.close()
"""


@contextmanager
def _server() -> "Generator[tuple[subprocess.Popen[str], tuple[str, int]]]":
    command = ["sh", "-c", f'ulimit -n {_MAX_FILES}; exec "$@"', "sh", sys.executable, "-c", textwrap.dedent(_SERVER)]
    pipe = subprocess.PIPE
    with subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=pipe, text=True) as process:
        try:
            assert process.stdout is not None
            yield process, ("127.0.0.1", int(process.stdout.readline()))
        finally:
            process.kill()


def _greeted(clients: list[socket.socket]) -> int:
    for client in clients:
        client.setblocking(False)
    count = 0
    for client in clients:
        with suppress(BlockingIOError):
            count += bool(client.recv(10))
    return count


@pytest.mark.parametrize("client_leaves", [True, False])
def test_a_shortage_of_descriptors_is_reported_once_and_accepting_resumes(*, client_leaves: bool) -> None:
    with _server() as (process, address):
        clients = [socket.create_connection(address) for _ in range(2 * _MAX_FILES)]
        time.sleep(2.5)  # asyncio has tried again twice
        first = _greeted(clients)
        assert 0 < first < _MAX_FILES
        if client_leaves:
            for client in clients:
                client.close()
            with socket.create_connection(address, 60) as another:
                assert another.recv(10) == b"hello"
        _, output = process.communicate("\n", timeout=60)
        for client in clients:
            client.close()
    assert process.returncode == 0
    assert output == (
        "this process has as many files open as it may (30; ulimit -n): close some, or raise the limit; "
        "after that, new connections are accepted again\n"
    )
