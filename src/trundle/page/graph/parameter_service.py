"""The graph's parameters, which clients read, set and watch."""

from msgspec import UNSET

from trundle.robots.names import is_legal_name
from trundle.ros import Node, RosError

from ..clients.connection import Connection
from ..clients.hub import Hub
from ..clients.protocol import ERROR, GetParameters, Parameter, SetParameters
from ..clients.server_messages import ParameterValues
from .parameter_values import flatten, from_parameter, to_parameter

_ALL = "/"
_DELETED: dict[str, object] = {}
"""Value in the update of a deleted parameter."""


class ParameterService:
    """Requests for parameters; one subscription at the master serves all clients."""

    def __init__(self, hub: Hub) -> None:
        self._hub = hub
        self._node: Node | None = None
        self._subscriptions: dict[Connection, set[str]] = {}
        """Names that each client watches; '/' for all."""
        self._known: set[str] = set()
        """Names of the parameters that are set, as far as known."""
        self._watching_node: Node | None = None
        """Node that watches the parameters."""

    def set_node(self, node: Node) -> None:
        """Use another node."""
        self._node = node

    async def get(self, node: Node, client: Connection, request: GetParameters) -> None:
        """Send parameters."""
        names = request.parameter_names or (_ALL,)
        parameters: list[Parameter] = []
        for name in names:
            if name != _ALL and not is_legal_name(name):
                continue
            value = await node.params.get(name, None)
            leaves = flatten(node.resolve(name), value)
            parameters += [to_parameter(*leaf) for leaf in leaves if leaf[1] is not None]
        _send(client, parameters, request.id)

    async def set(self, node: Node, client: Connection, request: SetParameters) -> None:
        """Set or delete parameters, and answer with their new values."""
        for parameter in request.parameters:
            try:
                value = await _set(node, parameter)
                self._changed(node.resolve(parameter.name), value)  # a master does not notify the setter
            except (RosError, ValueError, OverflowError) as error:
                client.send_status(ERROR, f"{parameter.name[:200]} is not set: {error}")
        if request.id is not None:
            names = tuple(parameter.name for parameter in request.parameters if is_legal_name(parameter.name))
            if names:
                await self.get(node, client, GetParameters(parameter_names=names, id=request.id))
            else:
                _send(client, [], request.id)

    async def watch(self, node: Node, client: Connection, names: tuple[str, ...]) -> None:
        """Start sending changes of parameters; no names: of all."""
        self._subscriptions.setdefault(client, set()).update(
            map(node.resolve, filter(is_legal_name, names)) if names else {_ALL}
        )
        if self._watching_node is not node:
            self._watching_node = node
            tree = await node.params.watch(_ALL, self._changed)
            self._known = {name for name, value in flatten(_ALL, tree) if value != _DELETED}

    def unwatch(self, node: Node, client: Connection, names: tuple[str, ...]) -> None:
        """Stop sending changes of parameters; no names: of all."""
        if names:
            self._subscriptions.get(client, set()).difference_update(map(node.resolve, filter(is_legal_name, names)))
        else:
            self._subscriptions.pop(client, None)

    def forget(self, client: Connection) -> None:
        """Remove a client that has disconnected."""
        self._subscriptions.pop(client, None)

    async def refresh(self, node: Node) -> None:
        """Watch through the current node, and send the changes since the last one."""
        if self._subscriptions and self._watching_node is not node:
            self._watching_node = node
            self._changed(_ALL, await node.params.watch(_ALL, self._changed))

    def _changed(self, name: str, value: object) -> None:
        """Send a changed parameter, or those of a changed namespace; deleted ones are sent without a value."""
        leaves = dict(flatten(name, value)) if value != _DELETED else {}
        below = name.rstrip("/") + "/"
        deleted = {known for known in self._known if known == name or known.startswith(below)} - leaves.keys()
        self._known = (self._known - deleted) | leaves.keys()
        changed = [to_parameter(*leaf) for leaf in leaves.items()] + [Parameter(known) for known in sorted(deleted)]
        for client, names in self._subscriptions.items():
            watched = [parameter for parameter in changed if _matches(parameter.name, names)]
            if watched:
                _send(client, watched, None)


async def _set(node: Node, parameter: Parameter) -> object:
    """Set or delete a parameter, and return its new value.

    Raises:
        RosError: the master does not answer, or refuses the value.
        ValueError: the name or the value is invalid.
        OverflowError: a number exceeds the range of floats.
    """
    if not is_legal_name(parameter.name) or not parameter.name:
        raise ValueError("invalid parameter name")
    if parameter.is_set:
        value = from_parameter(parameter)
        await node.params.set(parameter.name, value)
        return value
    if await node.params.has(parameter.name):
        await node.params.delete(parameter.name)
    return _DELETED


def _matches(name: str, watched: set[str]) -> bool:
    return _ALL in watched or name in watched or any(name.startswith(f"{namespace}/") for namespace in watched)


def _send(client: Connection, parameters: list[Parameter], request_id: str | None) -> None:
    client.send(ParameterValues(tuple(parameters), UNSET if request_id is None else request_id))
