"""What can go wrong between nodes.

TrundleError
└── RosError
    ├── MasterUnreachableError   nobody answers at ROS_MASTER_URI
    ├── MasterError              the master (or a node) answered, and said no
    ├── PortTakenError           another program listens where a server was asked for
    ├── ParameterError           no such parameter, or a value parameters cannot hold
    ├── MessageError             no such type or field, or a value that does not fit it
    │   └── DefinitionError      the text of a type cannot be read
    ├── ServiceError             a service said no, or could not be reached
    ├── TransformError           no such frame, or no transform at that time
    └── WireError                bytes from a peer that are not the protocol; never leaves this room
"""

from trundle.diagnostics import TrundleError


class RosError(TrundleError):
    """Everything `trundle.ros` raises."""


class MasterUnreachableError(RosError):
    """Nobody answers at the master's address."""

    def __init__(self, uri: str, reason: str) -> None:
        super().__init__(
            f"no ROS master answers at {uri} ({reason}); start one with `trundle core`, or set ROS_MASTER_URI"
        )
        self.uri = uri


class MasterError(RosError):
    """The master or a node answered a call with a failure."""


class PortTakenError(RosError):
    """Another program listens at the address asked for."""

    def __init__(self, host: str, port: int) -> None:
        super().__init__(
            f"port {port} on {host} is taken, probably by another ROS master; "
            f"use that one, stop it, or take another port with -p PORT"
        )
        self.port = port


class ParameterError(RosError):
    """A parameter that is not set, or a value that parameters cannot hold."""


class MessageError(RosError):
    """A message type or field that does not exist, or a value that does not fit it."""


class DefinitionError(MessageError):
    """The text of a message type that cannot be read."""

    def __init__(self, line: int, what: str) -> None:
        super().__init__(what)
        self.line = line


class ServiceError(RosError):
    """A service that is not there, or that answered a request with an error text."""


class TransformError(RosError):
    """A frame that does not exist, is not connected, or has no transform at the time asked for."""


class WireError(RosError):
    """Bytes from a peer that are not the protocol."""
