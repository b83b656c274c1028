"""Service client: one connection per call."""

import asyncio
import contextlib
import struct
from collections.abc import Mapping
from typing import TYPE_CHECKING

from trundle.base.waiting import WaitNotice

from ..errors import MasterError, MasterUnreachableError, MessageError, RosError, ServiceError, WireError
from ..messages.raw_message import Message, ServiceType, TypedMessage
from ..transport.headers import MAX_HEADER_BYTES, MAX_MESSAGE_BYTES, decode_header, encode_header, frame
from ..xmlrpc.http import host_and_port
from .node_context import NodeContext

if TYPE_CHECKING:
    from ..messages.message_library import Messages

_POLL_S = 0.05
"""Poll interval of the master for a missing service."""


async def call_service(
    node: NodeContext,
    name: str,
    type_name: str,
    request: TypedMessage | Mapping[str, object] | None,
    timeout_s: float | None,
) -> Message:
    """Call a service by its global name.

    Raises:
        ServiceError: the service is not available, fails or times out.
        MessageError: unknown type, or a request that does not fit it.
    """
    kind = node.messages.service(type_name)
    if request is None or isinstance(request, Mapping):
        request = node.new(kind.request, request and dict(request))
    uri = await _look_up(node, name)
    try:
        with node.loop.work.pending(f"the answer of {name}", is_answer=True):
            async with asyncio.timeout(timeout_s):
                return await _exchange(node.messages, node.name, uri, name, kind, request)
    except TimeoutError:
        raise ServiceError(f"{name} did not answer within {timeout_s:g} s") from None


async def call_service_bytes(node: NodeContext, name: str, kind: ServiceType, request: bytes) -> bytes:
    """Call a service by its global name with a serialized request, and return the serialized response.

    Raises:
        ServiceError: the service is not available, fails or breaks off.
    """
    return await _exchange_bytes(node.name, await _look_up(node, name), name, kind, request)


async def _look_up(node: NodeContext, name: str) -> str:
    """Return the rosrpc URI of a service.

    Raises:
        ServiceError: no node provides it.
    """
    try:
        return str(await node.master.call("lookupService", name))
    except MasterError:
        raise ServiceError(f"no node provides the service {name}") from None


async def wait_for_service(node: NodeContext, name: str, timeout_s: float | None) -> None:
    """Wait until a service is available, by its global name; waits for the master, too, as rospy does.

    Raises:
        ServiceError: timeout.
    """
    notice = WaitNotice(f"the service {name}", node.log.info)
    look_up = node.master.call
    try:
        async with asyncio.timeout(timeout_s):
            while True:
                changes = node.loop.local.service_changes  # before the look-up: later ones end the wait
                with contextlib.suppress(MasterError, MasterUnreachableError):
                    await look_up("lookupService", name)
                    return
                is_new = await node.loop.local.wait_service_change(changes, _POLL_S)
                look_up = node.master.call if is_new else node.master.poll
                notice.poll()
    except TimeoutError:
        raise ServiceError(f"no node provided the service {name} within {timeout_s:g} s") from None


async def probe_service(uri: str, name: str, caller: str) -> dict[str, str]:
    """Probe a provider for its connection header, which names the type.

    Raises:
        ServiceError: the provider does not answer.
    """
    try:
        async with asyncio.timeout(5.0), _connection(uri) as (reader, writer):
            writer.write(encode_header({"callerid": caller, "service": name, "md5sum": "*", "probe": "1"}))
            return decode_header(await _read_frame(reader, MAX_HEADER_BYTES))
    except (OSError, RosError, asyncio.IncompleteReadError) as error:
        raise ServiceError(f"{name} at {uri} does not answer: {error or type(error).__name__}") from None


async def _exchange(
    messages: "Messages", caller: str, uri: str, name: str, kind: ServiceType, request: Message
) -> Message:
    """Send a request to a provider as the node `caller`, and return the response.

    Raises:
        ServiceError: the provider refuses, fails or disconnects.
    """
    data = await _exchange_bytes(caller, uri, name, kind, messages.serialize(request))
    try:
        return messages.deserialize(data, kind.response)
    except MessageError as error:
        raise ServiceError(f"{name} sent an invalid response: {error}") from None


async def _exchange_bytes(caller: str, uri: str, name: str, kind: ServiceType, body: bytes) -> bytes:
    """Send a serialized request to a provider as the node `caller`, and return the serialized response.

    Raises:
        ServiceError: the provider refuses, fails or disconnects.
    """
    try:
        async with _connection(uri) as (reader, writer):
            header = {"callerid": caller, "service": name, "type": kind.type, "md5sum": kind.md5sum}
            writer.write(encode_header(header))
            answer = decode_header(await _read_frame(reader, MAX_HEADER_BYTES))
            if "error" in answer:
                raise ServiceError(f"{name} refuses: {answer['error']}")
            writer.write(frame(body))
            has_succeeded = await reader.readexactly(1) == b"\x01"
            data = await _read_frame(reader, MAX_MESSAGE_BYTES)
    except (OSError, WireError, asyncio.IncompleteReadError) as error:
        raise ServiceError(f"{name} at {uri} cannot be called: {error or type(error).__name__}") from None
    if not has_succeeded:
        raise ServiceError(f"service [{name}] responded with an error: {data.decode('utf-8', 'replace')}")
    return data


@contextlib.asynccontextmanager
async def _connection(uri: str):
    reader, writer = await asyncio.open_connection(*host_and_port(uri))
    try:
        yield reader, writer
    finally:
        writer.close()


async def _read_frame(reader: asyncio.StreamReader, limit: int) -> bytes:
    (size,) = struct.unpack("<I", await reader.readexactly(4))
    if size > limit:
        raise WireError(f"a frame of {size} bytes is announced, more than the {limit} accepted")
    return await reader.readexactly(size)
