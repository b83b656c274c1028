"""Exceptions of `trundle.ros`.

TrundleError
└── RosError
    ├── MasterUnreachableError   no master answers at ROS_MASTER_URI
    ├── MasterError              the master (or a node) answered with a failure
    ├── PortTakenError           the port is in use
    ├── ParameterError           no such parameter, or a value that parameters cannot hold
    ├── MessageError             no such type or field, or a value that does not fit it
    │   └── DefinitionError      the definition of a type cannot be parsed
    ├── ServiceError             a service answered with an error, or could not be reached
    ├── TransformError           no such transform
    │   ├── FrameNameError       an empty name, or one with a leading slash
    │   ├── UnknownFrameError    no such frame
    │   ├── ConnectivityError    the frames are in different trees
    │   └── ExtrapolationError   the time is outside the history
    └── WireError                a peer violated the protocol; never leaves this package
"""

from trundle.base.diagnostics import TrundleError


class RosError(TrundleError):
    """Base class of every exception that `trundle.ros` raises."""


class MasterUnreachableError(RosError):
    """No master answers at the address."""

    def __init__(self, uri: str, reason: str) -> None:
        super().__init__(
            f"no ROS master answers at {uri} ({reason}); start one with `trundle core`, or set ROS_MASTER_URI"
        )
        self.uri = uri


class MasterError(RosError):
    """The master or a node answered a call with a failure."""


class PortTakenError(RosError):
    """Another program listens on the port."""

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
    """A message definition that cannot be parsed."""

    def __init__(self, line: int, reason: str) -> None:
        super().__init__(reason)
        self.line = line


class ServiceError(RosError):
    """A service that is not available, or that answered with an error."""


class TransformError(RosError):
    """A frame that does not exist, is not connected, or has no transform at the requested time."""


class FrameNameError(TransformError):
    """A frame name that is empty or starts with a slash."""


class UnknownFrameError(TransformError):
    """A frame that does not exist."""


class ConnectivityError(TransformError):
    """Two frames in different trees."""


class ExtrapolationError(TransformError):
    """A time outside the history."""


class WireError(RosError):
    """A protocol violation by a peer."""
