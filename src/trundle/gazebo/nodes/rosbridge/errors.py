"""Errors of rosbridge's operations, in rosbridge_library's words."""

from collections.abc import Sequence


class RosbridgeError(Exception):
    """An operation fails; the client gets the text."""


class FieldTypeError(RosbridgeError):
    """A value does not fit its field."""

    def __init__(self, root: str, path: Sequence[str], expected: str, value: object) -> None:
        found = type(value)
        if root == expected:
            super().__init__(f"Expected a JSON object for type {root} but received a {found}")
        else:
            super().__init__(f"{root} message requires a {expected} for field {'.'.join(path)}, but got a {found}")


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

    def __init__(self, topic: str, established: str, given: str) -> None:
        super().__init__(
            f"Tried to register topic {topic} with type {given} but it is already established with type {established}"
        )


class NoServiceError(RosbridgeError):
    """Missing service."""

    def __init__(self, service: str) -> None:
        super().__init__(f"Service {service} does not exist")
