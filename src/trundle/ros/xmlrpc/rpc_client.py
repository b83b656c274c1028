"""XML-RPC calls on asyncio, of limited size, and with a timeout on request."""

import asyncio
import contextlib
from typing import Any

from ..errors import MasterError, WireError
from .http import MAX_BODY_BYTES, MAX_HEAD_BYTES, host_and_port, parse_head, request
from .xmlrpc_text import decode_response, encode_call


async def call(uri: str, method: str, *arguments: object, timeout_s: float | None = None) -> Any:
    """Call a method and return the decoded response.

    Raises:
        OSError: the connection fails (TimeoutError: no response in time).
        WireError: the peer does not speak XML-RPC.
        FaultError: the response is a fault.
    """
    host, port = host_and_port(uri)
    body = encode_call(method, arguments)
    async with asyncio.timeout(timeout_s):
        reader, writer = await asyncio.open_connection(host, port, limit=MAX_HEAD_BYTES)
        try:
            writer.write(request(uri, body))
            head = parse_head(await reader.readuntil(b"\r\n\r\n"))
            if head.start[1] != "200":
                raise WireError(f"{uri} answers {' '.join(head.start[1:])[:100]}")
            size = head.body_bytes
            answer = await reader.readexactly(size) if size is not None else await _read_until_closed(reader)
        except (asyncio.IncompleteReadError, asyncio.LimitOverrunError) as error:
            raise WireError(f"{uri} broke off its answer: {error}") from None
        finally:
            with contextlib.suppress(OSError):
                writer.close()
    return decode_response(answer)


async def call_value(uri: str, method: str, *arguments: object, timeout_s: float | None = None) -> Any:
    """Call a ROS method, which answers [code, text, value], and return the value.

    Raises:
        MasterError: the code is not 1.
        OSError, WireError, FaultError: see `call`.
    """
    return unpack_value(uri, method, await call(uri, method, *arguments, timeout_s=timeout_s))


def unpack_value(uri: str, method: str, answer: object) -> object:
    """Unpack [code, text, value] and return the value.

    Raises:
        MasterError: the code is not 1.
        WireError: the answer has another form.
    """
    if not isinstance(answer, list) or len(answer) != 3:
        raise WireError(f"{uri} answers {method} with {str(answer)[:100]!r}, not with [code, text, value]")
    code, text, value = answer
    if code != 1:
        raise MasterError(str(text))
    return value


async def _read_until_closed(reader: asyncio.StreamReader) -> bytes:
    data = bytearray()
    while chunk := await reader.read(65536):
        data += chunk
        if len(data) > MAX_BODY_BYTES:
            raise WireError("the answer never ends")
    return bytes(data)
