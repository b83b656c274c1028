"""Client of the master with names resolved, which is also a dictionary of parameters."""

from collections.abc import Iterator
from typing import Any

from . import core, names
from .exceptions import ROSException
from .impl import paramserver

_FIRST_IS_NAME = frozenset({
    "deleteParam", "setParam", "getParam", "searchParam", "subscribeParam", "unsubscribeParam", "hasParam",
    "registerService", "lookupService", "unregisterService", "registerSubscriber", "unregisterSubscriber",
    "registerPublisher", "unregisterPublisher", "lookupNode", "getPublishedTopics",
})  # fmt: skip


class MasterProxy:
    """The master: each method of its API, without the caller's name, returns (code, text, value)."""

    def __init__(self, uri: str | None) -> None:
        self.target = core.xmlrpcapi(uri)

    def __getattr__(self, key: str) -> Any:
        if key.startswith("__"):
            raise AttributeError(key)

        def call(*args: Any) -> Any:
            arguments = list(args)
            if key in _FIRST_IS_NAME and arguments:
                arguments[0] = names.resolve_name(arguments[0])
            return getattr(self.target, key)(core.get_caller_id(), *arguments)

        return call

    def __getitem__(self, key: str) -> Any:
        """Value of a parameter.

        Raises:
            KeyError: it is not set.
        """
        name = names.resolve_name(key)
        try:
            return paramserver.cache.get(name)
        except KeyError:
            code, _, value = self.target.getParam(core.get_caller_id(), name)
        if code != 1:
            raise KeyError(key)
        return value

    def __setitem__(self, key: str, val: Any) -> None:
        """Set a parameter."""
        name = names.resolve_name(key)
        self.target.setParam(core.get_caller_id(), name, val)
        paramserver.update(name, val)

    def __delitem__(self, key: str) -> None:
        """Delete a parameter.

        Raises:
            KeyError: it is not set.
        """
        name = names.resolve_name(key)
        code, text, _ = self.target.deleteParam(core.get_caller_id(), name)
        if code == -1:
            raise KeyError(key)
        if code != 1:
            raise ROSException(f"cannot delete parameter: {text}")

    def __contains__(self, key: str) -> bool:
        """True if a parameter is set."""
        code, text, value = self.target.hasParam(core.get_caller_id(), names.resolve_name(key))
        if code != 1:
            raise ROSException(f"cannot check parameter on server: {text}")
        return value

    def __iter__(self) -> Iterator[str]:
        """Names of all parameters."""
        code, text, value = self.target.getParamNames(core.get_caller_id())
        if code != 1:
            raise ROSException(f"cannot retrieve parameter names: {text}")
        return iter(value)

    def search_param(self, key: str) -> str | None:
        """Full name of the nearest parameter upwards; None if there is none."""
        key = names.get_mappings().get(key, key)
        code, text, value = self.target.searchParam(core.get_caller_id(), key)
        if code == 1:
            return value
        if code == -1:
            return None
        raise ROSException(f"cannot search for parameter: {text}")

    def get_param_cached(self, key: str) -> Any:
        """Value of a parameter, kept up to date by the master.

        Raises:
            KeyError: it is not set.
        """
        name = names.resolve_name(key)
        try:
            return paramserver.cache.get(name)
        except KeyError:
            value = paramserver.watch(name)
        if isinstance(value, dict) and not value:
            raise KeyError(key)
        return value
