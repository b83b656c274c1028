"""Probe of a publisher for its connection header, which holds the definition of its type."""

import asyncio

from ..errors import RosError, WireError
from ..transport.framing import LENGTH
from ..transport.headers import MAX_HEADER_BYTES, decode_header, encode_header
from ..xmlrpc.http import checked_address
from ..xmlrpc.rpc_client import call
from ..xmlrpc.xmlrpc_text import FaultError
from .node_context import NodeContext

_TIMEOUT_S = 5.0


async def probe_publisher(node: NodeContext, publisher: str, topic: str) -> dict[str, str]:
    """Return the connection header of a node's publisher: `type`, `md5sum`, `message_definition`.

    Raises:
        RosError: the node does not answer.
    """
    try:
        async with asyncio.timeout(_TIMEOUT_S):
            uri = str(await node.master.call("lookupNode", publisher))
            match await call(uri, "requestTopic", node.name, topic, [["TCPROS"]]):
                case [1, _, ["TCPROS", str(host), int(port), *_]]:
                    return await _exchange_headers(node.name, topic, host, port)
                case answer:
                    raise WireError(f"it does not offer TCPROS: {str(answer)[:100]}")
    except (OSError, RosError, FaultError, asyncio.IncompleteReadError) as error:
        raise RosError(f"{publisher} does not describe {topic}: {error or type(error).__name__}") from None


async def _exchange_headers(caller: str, topic: str, host: str, port: int) -> dict[str, str]:
    reader, writer = await asyncio.open_connection(*checked_address(host, port))
    try:
        writer.write(encode_header({"callerid": caller, "topic": topic, "type": "*", "md5sum": "*"}))
        (size,) = LENGTH.unpack(await reader.readexactly(LENGTH.size))
        if size > MAX_HEADER_BYTES:
            raise WireError(f"a header of {size} bytes is announced, more than the {MAX_HEADER_BYTES} accepted")
        return decode_header(await reader.readexactly(size))
    finally:
        writer.close()
