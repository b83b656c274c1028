"""The XML-RPC server serves other calls while it decodes a large one."""

import asyncio

from tests.ros.conftest import PATIENCE_S

from trundle.ros.xmlrpc.http import request
from trundle.ros.xmlrpc.rpc_server import RpcServer
from trundle.ros.xmlrpc.xmlrpc_text import encode_call


def test_a_small_call_is_answered_while_a_large_one_is_decoded() -> None:
    async def run() -> list[str]:
        handled: list[str] = []
        server = RpcServer(lambda method, _: handled.append(method))
        await server.start("127.0.0.1", 0)
        uri = f"http://127.0.0.1:{server.port}/"
        connections = [await asyncio.open_connection("127.0.0.1", server.port) for _ in range(2)]
        large, small = (writer for _, writer in connections)
        data = request(uri, encode_call("large", [[[]] * 50_000]))
        large.write(data[:-1])
        while large.transport.get_write_buffer_size() > 0:
            await asyncio.sleep(0.01)
        await asyncio.sleep(0.1)  # all but the last byte has arrived
        large.write(data[-1:])
        small.write(request(uri, encode_call("small", [])))
        for reader, writer in connections:
            await reader.read()
            writer.close()
        await server.stop()
        return handled

    assert asyncio.run(asyncio.wait_for(run(), PATIENCE_S)) == ["small", "large"]
