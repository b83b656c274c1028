"""Checks of an operation's fields, with rosbridge_library's messages."""

from collections.abc import Mapping
from dataclasses import dataclass

from .errors import RosbridgeError

_MAX_SHOWN = 200


@dataclass(frozen=True, slots=True)
class Field:
    """A field of an operation."""

    name: str
    types: tuple[type, ...]
    required: bool = True


def check_fields(message: Mapping[str, object], fields: tuple[Field, ...]) -> None:
    """Check that a message has the fields.

    Raises:
        RosbridgeError: a field is missing or of another type.
    """
    for field in fields:
        if field.name not in message:
            if field.required:
                raise RosbridgeError(f"Expected a {field.name} field but none was found.")
        elif not isinstance(message[field.name], field.types):
            shown = str(message[field.name])[:_MAX_SHOWN]
            raise RosbridgeError(f"Expected field {field.name} to be one of {field.types}. Invalid value: {shown}")


TOPIC = Field("topic", (str,))
SERVICE = Field("service", (str,))
_LATCH = Field("latch", (bool, int), required=False)
_QUEUE_SIZE = Field("queue_size", (int,), required=False)
ADVERTISE = (TOPIC, Field("type", (str,)), _LATCH, _QUEUE_SIZE)
PUBLISH = (TOPIC, _LATCH, _QUEUE_SIZE)
SUBSCRIBE = (
    TOPIC,
    Field("type", (str,), required=False),
    Field("throttle_rate", (int, float), required=False),
    Field("fragment_size", (int, type(None)), required=False),
    Field("queue_length", (int,), required=False),
    Field("compression", (str,), required=False),
)
CALL_SERVICE = (
    SERVICE,
    Field("fragment_size", (int, type(None)), required=False),
    Field("compression", (str,), required=False),
)
ADVERTISE_SERVICE = (SERVICE, Field("type", (str,)))
SERVICE_RESPONSE = (
    SERVICE,
    Field("id", (str,)),
    Field("values", (dict,), required=False),
    Field("result", (bool,)),
)
