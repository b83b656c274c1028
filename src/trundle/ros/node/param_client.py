"""Parameter client of one node; its methods are coroutines on the loop."""

import asyncio
from collections.abc import Awaitable, Callable, Mapping
from functools import partial
from typing import Any, TypeAlias

from ..errors import MasterError, MasterUnreachableError, ParameterError
from .node_context import NodeContext
from .registration_queue import RegistrationQueue

ParamCallback: TypeAlias = Callable[[str, Any], None]
"""Called with the changed name, without trailing slash, and its new value; {} if deleted."""
_UNSET: Any = object()


class ParamClient:
    """Access to the parameter server; names are resolved and remapped."""

    def __init__(self, node: NodeContext, private: Mapping[str, object]) -> None:
        """`private` parameters are set when the node starts; reads wait until they are set."""
        self._node = node
        self._private = dict(private)
        self._is_set = asyncio.Event()
        self._watched: dict[str, list[ParamCallback]] = {}

    async def get(self, name: str, default: Any = _UNSET) -> Any:
        """Get a parameter, or a namespace as a dictionary.

        Raises:
            ParameterError: the parameter is not set and there is no default.
            MasterUnreachableError: the master does not answer.
        """
        full = self._node.resolve(name)
        await self._wait_private()
        try:
            return await self._node.master.call("getParam", full)
        except MasterError:
            if default is _UNSET:
                raise ParameterError(f"parameter {full} is not set") from None
            return default

    async def set(self, name: str, value: Any) -> None:
        """Set a parameter, or a whole namespace from a dictionary.

        Raises:
            ParameterError: parameters cannot hold the value (integers have 32 bits).
            MasterUnreachableError: the master does not answer.
        """
        full = self._node.resolve(name)
        try:
            await self._node.master.call("setParam", full, value)
        except (ValueError, MasterError) as error:
            raise ParameterError(f"parameter {full}: {error}") from None

    async def delete(self, name: str) -> None:
        """Delete a parameter or a namespace.

        Raises:
            ParameterError: the parameter is not set.
        """
        full = self._node.resolve(name)
        try:
            await self._node.master.call("deleteParam", full)
        except MasterError:
            raise ParameterError(f"parameter {full} is not set") from None

    async def has(self, name: str) -> bool:
        """True if a parameter or namespace is set."""
        await self._wait_private()
        return bool(await self._node.master.call("hasParam", self._node.resolve(name)))

    async def search(self, key: str) -> str | None:
        """Full name of the nearest match upwards from this node; a remapped key is searched as written."""
        await self._wait_private()
        try:
            return str(await self._node.master.call("searchParam", self._node.written_remappings.get(key, key)))
        except MasterError:
            return None

    async def watch(self, name: str, callback: ParamCallback) -> object:
        """Subscribe to changes of a parameter or namespace; `callback` runs on the loop.

        Returns:
            The current value; {} if not set.
        """
        await self._node.wait_listening()
        full = self._node.resolve(name)
        self._watched.setdefault(full, []).append(callback)
        return await self._node.master.call("subscribeParam", self._node.uri, full)

    def register_again(self, registrations: RegistrationQueue) -> None:
        """Set the private parameters and subscribe to the watched ones again, at a restarted master."""
        for name, value in self._private.items():
            registrations.add(partial(self.set, f"~{name}", value))
        for name in self._watched:
            registrations.add(partial(self._subscribe, name))

    async def _subscribe(self, full: str) -> None:
        await self._node.master.call("subscribeParam", self._node.uri, full)

    def notify(self, key: str, value: object) -> bool:
        """Handle paramUpdate; False if there is no subscriber."""
        name = key.rstrip("/") or "/"
        matching = [
            callback
            for watched, callbacks in self._watched.items()
            if watched == "/" or name == watched or name.startswith(f"{watched}/")
            for callback in callbacks
        ]
        for callback in matching:
            callback(name, value)
        return bool(matching)

    def unwatch_all(self) -> list[Awaitable[object]]:
        """Master calls that unsubscribe all parameters."""
        return [self._node.master.call("unsubscribeParam", self._node.uri, name) for name in self._watched]

    async def set_private(self, registrations: RegistrationQueue) -> None:
        """Set the private parameters as soon as a master answers."""
        for name, value in self._private.items():
            await registrations.retry(lambda name=name, value=value: self._set_private(name, value))
        self._is_set.set()

    async def _set_private(self, name: str, value: Any) -> None:
        try:
            await self.set(f"~{name}", value)
        except MasterUnreachableError:
            self._is_set.set()  # readers that wait get the same error
            raise

    async def _wait_private(self) -> None:
        if self._private and not self._node.is_shut_down:
            await self._is_set.wait()
