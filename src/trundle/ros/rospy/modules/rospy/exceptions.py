"""Exceptions of rospy."""


class ROSException(Exception):
    """Base class of exceptions for programs."""


class ROSSerializationException(ROSException):
    """A message's field has a value that does not fit."""


class ROSInitException(ROSException):
    """The node is not initialized, or cannot be."""


class ROSInterruptException(ROSException, KeyboardInterrupt):
    """Interrupted by shutdown."""


class ROSTimeMovedBackwardsException(ROSInterruptException):
    """Simulated time jumped back."""

    def __init__(self, time: float) -> None:
        self.time = time
        """Jump [s]."""
        super().__init__("ROS time moved backwards")


class ROSInternalException(Exception):
    """Base class of internal failures."""


class TransportException(ROSInternalException):
    """Failure of a connection."""


class TransportTerminated(TransportException):
    """The connection broke."""


class TransportInitError(TransportException):
    """The connection failed."""
