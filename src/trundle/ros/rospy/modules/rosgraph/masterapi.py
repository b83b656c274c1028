"""The master's API, with checked responses."""

from typing import Any

from .names import make_caller_id
from .network import parse_http_host_and_port
from .rosenv import get_master_uri
from .server_proxy import ServerProxy


class MasterException(Exception):
    """Base class."""


class MasterFailure(MasterException):
    """The call failed."""


class MasterError(MasterException):
    """Invalid arguments, or an unknown name."""


ROSMasterException = MasterException
Error = MasterError
Failure = MasterFailure

_METHODS = frozenset({
    "deleteParam", "setParam", "getParam", "searchParam", "subscribeParam", "unsubscribeParam", "hasParam",
    "getParamNames", "getPid", "getUri", "registerService", "lookupService", "unregisterService",
    "registerSubscriber", "unregisterSubscriber", "registerPublisher", "unregisterPublisher", "lookupNode",
    "getPublishedTopics", "getTopicTypes", "getSystemState",
})  # fmt: skip


def is_online(master_uri: str | None = None) -> bool:
    """True if a master answers."""
    return Master("rosgraph", master_uri=master_uri).is_online()


class Master:
    """Client of the master; each method of its API returns the response's value.

    Methods raise MasterError or MasterFailure by the response's code, and OSError if no master responds.
    """

    def __init__(self, caller_id: str, master_uri: str | None = None) -> None:
        """Create a client; default: for the environment's master.

        Raises:
            ValueError: the URI is invalid.
        """
        self._reinit(get_master_uri() if master_uri is None else master_uri)
        self.caller_id = make_caller_id(caller_id).removesuffix("/")

    def _reinit(self, master_uri: str | None) -> None:
        if master_uri is None:
            raise ValueError("ROS master URI is not set")
        try:
            parse_http_host_and_port(master_uri)
        except ValueError:
            raise ValueError(f"invalid master URI: {master_uri}") from None
        self.master_uri = master_uri
        self.handle = ServerProxy(master_uri)

    def is_online(self) -> bool:
        """True if the master answers."""
        try:
            self.getPid()
        except OSError:
            return False
        return True

    def __getattr__(self, name: str) -> Any:
        if name not in _METHODS:
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")

        def call(*arguments: Any) -> Any:
            return self._succeed(getattr(self.handle, name)(self.caller_id, *arguments))

        return call

    def _succeed(self, args: Any) -> Any:
        code, text, value = args
        if code == 1:
            return value
        raise (MasterError if code == -1 else MasterFailure)(text)
