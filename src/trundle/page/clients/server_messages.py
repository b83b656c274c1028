"""Messages of the Foxglove WebSocket protocol and of `trundle.v1` that the server sends as text."""

from typing import TypeAlias

import msgspec
from msgspec import UNSET, UnsetType

from .protocol import ENCODING, SCHEMA_ENCODING, Parameter


class ServerMessage(msgspec.Struct, frozen=True, tag_field="op", rename="camel"):
    """Base of text messages from the server."""


class ServerInfo(ServerMessage, frozen=True, kw_only=True, tag="serverInfo"):
    """First message to a client."""

    name: str = "trundle"
    capabilities: tuple[str, ...]
    """Operations that the client may use, by the protocol's names."""
    supported_encodings: tuple[str, ...] = (ENCODING,)
    metadata: dict[str, str] = {}
    session_id: str
    """Distinguishes this server from an earlier one at the same address."""


class Status(ServerMessage, frozen=True, tag="status"):
    """Status of the server; replaces the earlier one with the same id."""

    level: int
    """`INFO`, `WARNING` or `ERROR`."""
    message: str
    id: str | UnsetType = UNSET


class RemoveStatus(ServerMessage, frozen=True, tag="removeStatus"):
    """Ids of status messages that end."""

    status_ids: tuple[str, ...]


class ChannelOffer(msgspec.Struct, frozen=True, kw_only=True, rename="camel"):
    """Channel that a client may subscribe to."""

    id: int
    topic: str
    encoding: str
    schema_name: str
    """Type of its messages: `sensor_msgs/LaserScan`."""
    schema: str
    """Full definition of the type."""
    schema_encoding: str | UnsetType = UNSET


class AdvertiseChannels(ServerMessage, frozen=True, tag="advertise"):
    """New channels."""

    channels: tuple[ChannelOffer, ...]


class UnadvertiseChannels(ServerMessage, frozen=True, tag="unadvertise"):
    """Ids of channels that end, with their subscriptions."""

    channel_ids: tuple[int, ...]


class ServiceSchema(msgspec.Struct, frozen=True, kw_only=True, rename="camel"):
    """Type of a service's requests or responses."""

    encoding: str = ENCODING
    schema_encoding: str = SCHEMA_ENCODING
    schema_name: str
    schema: str


class ServiceOffer(msgspec.Struct, frozen=True, kw_only=True, rename="camel"):
    """Service that a client may call, with its types in the protocol's newer and older form."""

    id: int
    name: str
    type: str
    request: ServiceSchema
    response: ServiceSchema
    request_schema: str
    response_schema: str


class AdvertiseServices(ServerMessage, frozen=True, tag="advertiseServices"):
    """New services."""

    services: tuple[ServiceOffer, ...]


class UnadvertiseServices(ServerMessage, frozen=True, tag="unadvertiseServices"):
    """Ids of services that end."""

    service_ids: tuple[int, ...]


class ServiceCallFailure(ServerMessage, frozen=True, kw_only=True, tag="serviceCallFailure"):
    """Service call that failed."""

    service_id: int
    call_id: int
    message: str


class ParameterValues(ServerMessage, frozen=True, tag="parameterValues"):
    """Requested or changed parameters."""

    parameters: tuple[Parameter, ...]
    id: str | UnsetType = UNSET
    """Id of the answered request."""


class PublishedTopic(msgspec.Struct, frozen=True, rename="camel"):
    """Current publishers of a topic."""

    name: str
    publisher_ids: tuple[str, ...]


class SubscribedTopic(msgspec.Struct, frozen=True, rename="camel"):
    """Current subscribers of a topic."""

    name: str
    subscriber_ids: tuple[str, ...]
    type: str
    """Datatype, `*` if unknown; an addition to the protocol, as a topic without a publisher has no channel."""


class ProvidedService(msgspec.Struct, frozen=True, rename="camel"):
    """Current providers of a service."""

    name: str
    provider_ids: tuple[str, ...]


class ConnectionGraphUpdate(ServerMessage, frozen=True, kw_only=True, tag="connectionGraphUpdate"):
    """Topics and services whose nodes have changed."""

    published_topics: tuple[PublishedTopic, ...]
    subscribed_topics: tuple[SubscribedTopic, ...]
    advertised_services: tuple[ProvidedService, ...]
    removed_topics: tuple[str, ...]
    removed_services: tuple[str, ...]


class Response(ServerMessage, frozen=True, tag="trundle/response"):
    """Answer to a request of `trundle.v1`; if it is `ok`, the fields of its `Answer` follow."""

    id: int | str
    ok: bool
    error: str | UnsetType = UNSET
    """Reason for a failure."""


class DriveReceipt(ServerMessage, frozen=True, tag="trundle/driven"):
    """Receipt of a velocity command."""

    number: int


ServerOperation: TypeAlias = (
    ServerInfo
    | Status
    | RemoveStatus
    | AdvertiseChannels
    | UnadvertiseChannels
    | AdvertiseServices
    | UnadvertiseServices
    | ServiceCallFailure
    | ParameterValues
    | ConnectionGraphUpdate
    | Response
    | DriveReceipt
)
