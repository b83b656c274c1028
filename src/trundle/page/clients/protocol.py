"""Messages of the Foxglove WebSocket protocol and of `trundle.v1`: those from clients, and headers of those to clients.

Fields and opcodes are from the published specification, foxglove/ws-protocol docs/spec.md;
docs/protocol.md describes the additions of `trundle.v1`.
"""

import struct
from typing import Annotated, Literal, TypeAlias

import msgspec

FOXGLOVE, FOXGLOVE_SDK, TRUNDLE = "foxglove.websocket.v1", "foxglove.sdk.v1", "trundle.v1"
TRUNDLE_DRIVE = "trundle.drive.v1"
"""Only drives: no channels, services or times delay its messages."""
SUBPROTOCOLS = (TRUNDLE, TRUNDLE_DRIVE, FOXGLOVE_SDK, FOXGLOVE)
ENCODING = "ros1"
SCHEMA_ENCODING = "ros1msg"
CAPABILITIES = ("assets", "time")
GRAPH_CAPABILITIES = ("clientPublish", "parameters", "parametersSubscribe", "services", "connectionGraph")
"""Further capabilities of a page with a ROS graph."""
CONTROL_CAPABILITIES = ("clientPublish", "services")
"""Capabilities that view-only clients do not have."""

_MAX_LIST = 10_000
_MAX_NAME = 1_000
U32: TypeAlias = Annotated[int, msgspec.Meta(ge=0, lt=2**32)]
Name: TypeAlias = Annotated[str, msgspec.Meta(max_length=_MAX_NAME)]
Names: TypeAlias = Annotated[tuple[Name, ...], msgspec.Meta(max_length=_MAX_LIST)]
Ids: TypeAlias = Annotated[tuple[U32, ...], msgspec.Meta(max_length=_MAX_LIST)]
Velocity: TypeAlias = float
Size: TypeAlias = Annotated[int, msgspec.Meta(ge=2, le=500)]


class Operation(msgspec.Struct, frozen=True, tag_field="op", rename="camel"):
    """Base of text messages from clients."""


class Subscription(msgspec.Struct, frozen=True, rename="camel"):
    """Channel that a client subscribes to, with the subscription's id."""

    id: U32
    channel_id: U32


class Subscribe(Operation, frozen=True, tag="subscribe"):
    """Subscribe to channels."""

    subscriptions: Annotated[tuple[Subscription, ...], msgspec.Meta(max_length=_MAX_LIST)]


class Unsubscribe(Operation, frozen=True, tag="unsubscribe"):
    """End subscriptions."""

    subscription_ids: Ids


class ClientChannel(msgspec.Struct, frozen=True, rename="camel"):
    """Topic that a client publishes to."""

    id: U32
    topic: Name
    encoding: Name
    schema_name: Name
    schema: str | None = None


class Advertise(Operation, frozen=True, tag="advertise"):
    """Advertise topics that the client publishes to."""

    channels: Annotated[tuple[ClientChannel, ...], msgspec.Meta(max_length=_MAX_LIST)]


class Unadvertise(Operation, frozen=True, tag="unadvertise"):
    """Stop publishing to topics."""

    channel_ids: Ids


class GetParameters(Operation, frozen=True, tag="getParameters"):
    """Request parameters; no names: all."""

    parameter_names: Names
    id: str | None = None


class Parameter(msgspec.Struct, frozen=True, omit_defaults=True):
    """Parameter and its value; unset: the parameter is deleted or not set."""

    name: Name
    value: object = msgspec.UNSET
    type: Literal["byte_array", "float64", "float64_array"] | None = None

    @property
    def is_set(self) -> bool:
        """True if the parameter has a value."""
        return self.value is not msgspec.UNSET


class SetParameters(Operation, frozen=True, tag="setParameters"):
    """Set or delete parameters."""

    parameters: Annotated[tuple[Parameter, ...], msgspec.Meta(max_length=_MAX_LIST)]
    id: str | None = None


class SubscribeParameterUpdates(Operation, frozen=True, tag="subscribeParameterUpdates"):
    """Subscribe to changes of parameters; no names: of all."""

    parameter_names: Names


class UnsubscribeParameterUpdates(Operation, frozen=True, tag="unsubscribeParameterUpdates"):
    """Unsubscribe from changes of parameters; no names: from all."""

    parameter_names: Names


class SubscribeConnectionGraph(Operation, frozen=True, tag="subscribeConnectionGraph"):
    """Subscribe to the nodes of topics and services."""


class UnsubscribeConnectionGraph(Operation, frozen=True, tag="unsubscribeConnectionGraph"):
    """Unsubscribe from the nodes of topics and services."""


class FetchAsset(Operation, frozen=True, tag="fetchAsset"):
    """Request a file."""

    uri: Name
    request_id: U32


class Drive(Operation, frozen=True, tag="trundle/drive"):
    """Drive at a velocity, which the server repeats at 10 Hz until the lease of the latest such message ends."""

    topic: Name
    linear: Velocity
    """Forward [m/s]."""
    angular: Velocity
    """To the left [rad/s]."""
    lease: Annotated[float, msgspec.Meta(gt=0, le=1)] = 0.3
    """Time from the message's arrival [s]."""
    number: U32 | None = None
    """Number of the receipt that answers the message; None: no answer."""


class Release(Operation, frozen=True, tag="trundle/release"):
    """Stop driving."""

    topic: Name


class SelectedModel(msgspec.Struct, frozen=True, tag_field="kind", tag="model", forbid_unknown_fields=True):
    """Model of the simulated world."""

    model: Name


class SelectedLink(msgspec.Struct, frozen=True, tag_field="kind", tag="link", forbid_unknown_fields=True):
    """Link of a model."""

    model: Name
    link: Name


class SelectedJoint(msgspec.Struct, frozen=True, tag_field="kind", tag="joint", forbid_unknown_fields=True):
    """Joint of a model."""

    model: Name
    joint: Name


class SelectedLight(msgspec.Struct, frozen=True, tag_field="kind", tag="light", forbid_unknown_fields=True):
    """Light of the world."""

    light: Name


SharedSelection: TypeAlias = SelectedModel | SelectedLink | SelectedJoint | SelectedLight
"""A user's selection in the simulated world, shown to the other users."""


class Presence(Operation, frozen=True, tag="trundle/presence"):
    """Show this client's selection to the other users."""

    selection: SharedSelection | None


class UseTerminal(Operation, frozen=True, tag="trundle/terminal"):
    """Send input to a node's terminal, or change its size."""

    number: U32
    text: Annotated[str, msgspec.Meta(max_length=4096)] = ""
    size: tuple[Size, Size] | None = None
    """Columns and rows; None: unchanged."""


class Echo(Operation, frozen=True, tag="trundle/echo"):
    """Echo of a mark, after everything before it was handled."""

    mark: U32


class PageRequest(Operation, frozen=True, tag="trundle/request"):
    """Request to the page's owner; `trundle.page.requests.request` reads its fields."""

    id: int | Name
    request: Name = ""


ClientOperation: TypeAlias = (
    Subscribe
    | Unsubscribe
    | Advertise
    | Unadvertise
    | GetParameters
    | SetParameters
    | SubscribeParameterUpdates
    | UnsubscribeParameterUpdates
    | SubscribeConnectionGraph
    | UnsubscribeConnectionGraph
    | FetchAsset
    | Drive
    | Release
    | Presence
    | UseTerminal
    | Echo
    | PageRequest
)
operation_decoder = msgspec.json.Decoder(ClientOperation)

CLIENT_MESSAGE, CLIENT_SERVICE_CALL = 1, 2
CLIENT_MESSAGE_HEADER = struct.Struct("<BI")
"""Opcode, channel id."""
SERVICE_HEADER = struct.Struct("<BIII")
"""Opcode, service id, call id, length of the encoding's name; for requests and responses."""
_MESSAGE_HEADER = struct.Struct("<BIQ")
_STAMPED_HEADER = struct.Struct("<BIQQ")
_MARK = struct.Struct("<BIQ")
_PART_HEADER = struct.Struct("<BIBB")
_TIME = struct.Struct("<BQ")
_ASSET_HEADER = struct.Struct("<BIBI")
_U64 = 2**64 - 1
INFO, WARNING, ERROR = 0, 1, 2
"""Levels of a status message."""


def message_header(subscription_id: int, time_ns: int) -> bytes:
    """Return the header of a message on a channel."""
    return _MESSAGE_HEADER.pack(1, subscription_id, time_ns & _U64)


def stamped_header(subscription_id: int, time_ns: int, wall_ns: int) -> bytes:
    """Return the header of a message on a channel of `trundle.v1`, with the wall time at which the server had it."""
    return _STAMPED_HEADER.pack(0x81, subscription_id, time_ns & _U64, wall_ns)


def mark_message(number: int, wall_ns: int) -> bytes:
    """Return a mark that a client of `trundle.v1` echoes, with the wall time at which it was sent."""
    return _MARK.pack(0x82, number, wall_ns)


def part_header(flow: int, *, is_last: bool, is_text: bool) -> bytes:
    """Return the header of a part of a message of `trundle.v1`; parts of several flows alternate."""
    return _PART_HEADER.pack(0x80, flow, is_last, is_text)


def time_message(time_ns: int) -> bytes:
    """Return a message with the server's time."""
    return _TIME.pack(2, time_ns & _U64)


def service_header(service_id: int, call_id: int) -> bytes:
    """Return the header of a service's response."""
    return SERVICE_HEADER.pack(3, service_id, call_id, len(ENCODING)) + ENCODING.encode()


def asset_header(request_id: int, error: str | None) -> bytes:
    """Return the header of a file, or the message with the reason for a failure."""
    text = b"" if error is None else error.encode("utf-8", "replace")
    return _ASSET_HEADER.pack(4, request_id, int(error is not None), len(text)) + text
