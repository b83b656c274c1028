"""Exceptions about messages."""


class MessageException(Exception):
    """Base class."""


class DeserializationError(MessageException):
    """Bytes that are not a message of the type."""


class SerializationError(MessageException):
    """A field's value does not fit its type."""
