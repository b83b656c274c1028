"""Base of the types of messages."""

from typing import Protocol


class TypedMessage(Protocol):
    """Attribute of every message object: its type in rosbags' form."""

    __msgtype__: str
