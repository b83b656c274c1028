"""Errors of rosbridge's operations, with rosbridge_library's messages."""

from collections.abc import Sequence


class RosbridgeError(Exception):
    """Failed operation; the client receives the text."""


class FieldTypeError(RosbridgeError):
    """A value does not fit its field."""

    def __init__(self, root: str, path: Sequence[str], expected: str, value: object) -> None:
        received = type(value)
        if root == expected:
            super().__init__(f"Expected a JSON object for type {root} but received a {received}")
        else:
            super().__init__(f"{root} message requires a {expected} for field {'.'.join(path)}, but got a {received}")


class NoFieldError(RosbridgeError):
    """Missing field of a type."""

    def __init__(self, root: str, path: Sequence[str]) -> None:
        super().__init__(f"Message type {root} does not have a field {'.'.join(path)}")


class TopicNotEstablishedError(RosbridgeError):
    """A topic has no type yet."""

    def __init__(self, topic: str) -> None:
        super().__init__(f"Cannot infer topic type for topic {topic} as it is not yet advertised")


class TypeConflictError(RosbridgeError):
    """A topic has another type."""

    def __init__(self, topic: str, established: str, requested: str) -> None:
        super().__init__(
            f"Tried to register topic {topic} with type {requested} but it is already established with type "
            f"{established}"
        )


class NoServiceError(RosbridgeError):
    """Missing service."""

    def __init__(self, service: str) -> None:
        super().__init__(f"Service {service} does not exist")
