"""What a node asks the master and service providers: the half of `Node` that waits for answers, on the loop."""

import asyncio
import contextlib
from collections.abc import Callable
from typing import Any, TypeAlias

from ..errors import MasterError, MasterUnreachableError, ParameterError, ServiceError, WireError
from ..messages.messages import Message, Messages
from ..xmlrpc.rpc_client import call_value
from ..xmlrpc.xmlrpc import FaultError
from .clock import Clock
from .loop import GraphLoop
from .service import call_service

ParamCallback: TypeAlias = Callable[[str, Any], None]
"""Gets the name of what changed, without a slash at its end, and its new value; {} where it was deleted."""
_UNSET: Any = object()
_MASTER_S = 5.0
"""How long the master may take for an answer."""
_POLL_S = 0.05


class NodeMasterCalls:
    """Calls of one node to the master and to services."""

    name: str
    master_uri: str
    loop: GraphLoop
    clock: Clock
    written_remappings: dict[str, str]
    """Name → name, both as written, not resolved."""
    watched: dict[str, list[ParamCallback]]
    """Parameters that this node is told about."""

    @property
    def uri(self) -> str:
        """Address of the node's XML-RPC interface."""
        raise NotImplementedError

    def resolve(self, name: str) -> str:
        """Return the global name this node means by `name`."""
        raise NotImplementedError

    async def wait_params(self) -> None:
        """Wait until the node's own parameters are set."""
        raise NotImplementedError

    async def wait_listening(self) -> None:
        """Wait until the node has an address."""
        raise NotImplementedError

    @property
    def messages(self) -> Messages:
        """Message types of the loop."""
        return self.loop.messages

    def new(self, type_name: str, fields: object = None) -> Message:
        """Make a message; 'now' and 'auto' are this node's ROS time. See `Messages.new`."""
        return self.messages.new(type_name, fields, now_ns=self.clock.now_ns())

    def stamp(self) -> Message:
        """ROS time as a `time` value."""
        return self.messages.stamp(self.clock.now_ns())

    async def call_master(self, method: str, *arguments: object) -> Any:
        """Call the master and return the value it answers with.

        Raises:
            MasterUnreachableError: nobody answers.
            MasterError: the master answers with a failure.
        """
        try:
            with self.loop.work.pending():
                return await call_value(self.master_uri, method, self.name, *arguments, timeout_s=_MASTER_S)
        except (OSError, WireError) as error:
            raise MasterUnreachableError(self.master_uri, str(error) or "no answer in time") from None
        except FaultError as error:
            raise MasterError(f"{method}: {error}") from None

    async def get_param(self, name: str, default: Any = _UNSET) -> Any:
        """Return a parameter, or a namespace as a dictionary.

        Raises:
            ParameterError: it is not set and there is no default.
            MasterUnreachableError: nobody answers.
        """
        full = self.resolve(name)
        await self.wait_params()
        try:
            return await self.call_master("getParam", full)
        except MasterError:
            if default is _UNSET:
                raise ParameterError(f"parameter {full} is not set") from None
            return default

    async def set_param(self, name: str, value: Any) -> None:
        """Set a parameter, or a whole namespace from a dictionary.

        Raises:
            ParameterError: parameters cannot hold the value (integers have 32 bits).
            MasterUnreachableError: nobody answers.
        """
        full = self.resolve(name)
        try:
            await self.call_master("setParam", full, value)
        except (ValueError, MasterError) as error:
            raise ParameterError(f"parameter {full}: {error}") from None

    async def delete_param(self, name: str) -> None:
        """Delete a parameter or a namespace.

        Raises:
            ParameterError: it is not set.
        """
        full = self.resolve(name)
        try:
            await self.call_master("deleteParam", full)
        except MasterError:
            raise ParameterError(f"parameter {full} is not set") from None

    async def has_param(self, name: str) -> bool:
        """Tell whether a parameter or a namespace is set."""
        await self.wait_params()
        return bool(await self.call_master("hasParam", self.resolve(name)))

    async def search_param(self, key: str) -> str | None:
        """Find the full name of the nearest parameter upwards from this node; a remapped key is searched as written."""
        await self.wait_params()
        try:
            return str(await self.call_master("searchParam", self.written_remappings.get(key, key)))
        except MasterError:
            return None

    async def param_names(self) -> list[str]:
        """Name every parameter of the graph."""
        return list(await self.call_master("getParamNames"))

    async def watch_param(self, name: str, callback: ParamCallback) -> Any:
        """Have a function called, on the loop, whenever a parameter or something below it changes.

        Returns:
            The value now; {} if it is not set.
        """
        await self.wait_listening()
        full = self.resolve(name)
        self.watched.setdefault(full, []).append(callback)
        return await self.call_master("subscribeParam", self.uri, full)

    def param_changed(self, key: str, value: Any) -> bool:
        """Tell those who watch a parameter; False: nobody does."""
        name = key.rstrip("/") or "/"
        told = [
            callback
            for watched, callbacks in self.watched.items()
            if watched == "/" or name == watched or name.startswith(f"{watched}/")
            for callback in callbacks
        ]
        for callback in told:
            callback(name, value)
        return bool(told)

    async def call_service(
        self,
        name: str,
        type_name: str,
        request: Message | dict[str, Any] | None = None,
        *,
        timeout_s: float | None = 10.0,
    ) -> Message:
        """Call a service.

        Raises:
            ServiceError: it is not there, says no, or does not answer in time.
            MessageError: no such type, or a request that does not fit it.
        """
        full = self.resolve(name)
        kind = self.messages.service(type_name)
        if request is None or isinstance(request, dict):
            request = self.new(kind.request, request)
        try:
            uri = await self.call_master("lookupService", full)
        except MasterError:
            raise ServiceError(f"no node provides the service {full}") from None
        try:
            with self.loop.work.pending():
                async with asyncio.timeout(timeout_s):
                    return await call_service(self.messages, self.name, uri, full, kind, request)
        except TimeoutError:
            raise ServiceError(f"{full} did not answer within {timeout_s:g} s") from None

    async def wait_for_service(self, name: str, timeout_s: float | None = None) -> None:
        """Wait until a node provides a service.

        Raises:
            ServiceError: none does in time.
        """
        full = self.resolve(name)
        try:
            async with asyncio.timeout(timeout_s):
                while True:
                    with contextlib.suppress(MasterError):
                        await self.call_master("lookupService", full)
                        return
                    await self.loop.wait_service_change(_POLL_S)
        except TimeoutError:
            raise ServiceError(f"no node provided the service {full} within {timeout_s:g} s") from None
