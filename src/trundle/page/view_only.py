"""Refusals to view-only clients and to those that only drive: only the operations listed here are allowed."""

from .clients.connection import Connection
from .clients.protocol import (
    CLIENT_SERVICE_CALL,
    ERROR,
    SERVICE_HEADER,
    ClientOperation,
    Drive,
    Echo,
    FetchAsset,
    GetParameters,
    PageRequest,
    Presence,
    Release,
    Subscribe,
    SubscribeConnectionGraph,
    SubscribeParameterUpdates,
    Unsubscribe,
    UnsubscribeConnectionGraph,
    UnsubscribeParameterUpdates,
)  # fmt: skip
from .clients.server_messages import ServiceCallFailure
from .owner import respond
from .requests.lessons import LessonAction
from .requests.request import Definition, PlotSeries

REFUSAL = "this link is view-only"
_DRIVE_REFUSAL = "a socket of trundle.drive.v1 only drives"
_READ_ONLY = (
    Subscribe, Unsubscribe, GetParameters, SubscribeParameterUpdates, UnsubscribeParameterUpdates,
    SubscribeConnectionGraph, UnsubscribeConnectionGraph, FetchAsset, Presence, PageRequest, Echo,
)  # fmt: skip
"""Operations that change nothing; `allows_request` checks requests."""


def allows(client: Connection, operation: ClientOperation) -> bool:
    """Return True if a client may do an operation; otherwise send it a status message."""
    if client.only_drives and not isinstance(operation, Drive | Release):
        client.send_status(ERROR, _DRIVE_REFUSAL)
        return False
    if not client.is_view_only or isinstance(operation, _READ_ONLY):
        return True
    client.send_status(ERROR, REFUSAL)
    return False


def allows_request(client: Connection, client_id: int | str, action: object) -> bool:
    """Return True if a client may make a request; otherwise answer with a refusal."""
    if not client.is_view_only or isinstance(action, Definition | PlotSeries | LessonAction):
        return True
    respond(client, client_id, REFUSAL)
    return False


def allows_binary(client: Connection, message: bytes) -> bool:
    """Return True if a client may publish and call services; otherwise answer with a refusal."""
    if client.only_drives:
        client.send_status(ERROR, _DRIVE_REFUSAL)
        return False
    if not client.is_view_only:
        return True
    if message[:1] == bytes((CLIENT_SERVICE_CALL,)) and len(message) >= SERVICE_HEADER.size:
        _, service_id, call_id, _ = SERVICE_HEADER.unpack_from(message)
        client.send(ServiceCallFailure(service_id=service_id, call_id=call_id, message=REFUSAL))
    else:
        client.send_status(ERROR, REFUSAL)
    return False
