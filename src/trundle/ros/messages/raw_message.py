"""Types of messages as objects and bytes, and of services; the type store takes longer to import."""

from typing import Any, NamedTuple, Protocol, TypeAlias

Message: TypeAlias = Any
"""A message object: a dataclass made by rosbags, with the fields of its ROS type. Number arrays are numpy arrays,
`time` and `duration` have `sec` and `nanosec`, a field that is a Python keyword gets a trailing `_`."""

ANY_TYPE = "*"


class TypedMessage(Protocol):
    """Attribute of every message object: its type in rosbags' form."""

    __msgtype__: str


class RawMessage(NamedTuple):
    """A serialized message with its connection header, for counting, storing or relaying."""

    type: str
    md5sum: str
    definition: str
    data: bytes | memoryview
    """Read-only; long messages are received in place and not copied."""
    caller: str = ""
    """Node that published it."""
    latching: bool = False
    """True if the publisher latches."""


class ServiceType(NamedTuple):
    """A service type: name, md5 sum, request and response types."""

    type: str
    md5sum: str
    request: str
    response: str
