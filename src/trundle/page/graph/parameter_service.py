"""The graph's parameters: read, set, and watched by clients."""

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
"""Value in the update of a parameter that was deleted."""


class ParameterService:
    """Answers about parameters; one subscription at the master serves all clients."""

    def __init__(self, hub: Hub) -> None:
        self._hub = hub
        self._node: Node | None = None
        self._wanted: dict[Connection, set[str]] = {}
        """Names that a client watches; '/' for all."""
        self._known: set[str] = set()
        """Parameters that are set, as last read or notified."""
        self._watched: Node | None = None
        """Node that watches the parameters."""

    def set_node(self, node: Node) -> None:
        """Use another node from now on."""
        self._node = node

    async def get(self, node: Node, client: Connection, wanted: GetParameters) -> None:
        """Send parameters."""
        names = wanted.parameter_names or (_ALL,)
        found: list[Parameter] = []
        for name in names:
            if name != _ALL and not is_legal_name(name):
                continue
            value = await node.params.get(name, None)
            found += [to_parameter(*leaf) for leaf in flatten(node.resolve(name), value) if leaf[1] is not None]
        _send(client, found, wanted.id)

    async def set(self, node: Node, client: Connection, wanted: SetParameters) -> None:
        """Set or delete parameters, and answer with what they are then."""
        for parameter in wanted.parameters:
            try:
                self._changed(
                    node.resolve(parameter.name), await _set(node, parameter)
                )  # a master does not notify who sets
            except (RosError, ValueError, OverflowError) as error:
                client.send_status(ERROR, f"{parameter.name[:200]} is not set: {error}")
        if wanted.id is not None:
            names = tuple(parameter.name for parameter in wanted.parameters if is_legal_name(parameter.name))
            if names:
                await self.get(node, client, GetParameters(parameter_names=names, id=wanted.id))
            else:
                _send(client, [], wanted.id)

    async def watch(self, node: Node, client: Connection, names: tuple[str, ...]) -> None:
        """Send changes of parameters from now on; no names: of all."""
        self._wanted.setdefault(client, set()).update(
            map(node.resolve, filter(is_legal_name, names)) if names else {_ALL}
        )
        if self._watched is not node:
            self._watched = node
            tree = await node.params.watch(_ALL, self._changed)
            self._known = {name for name, value in flatten(_ALL, tree) if value != _DELETED}

    def unwatch(self, node: Node, client: Connection, names: tuple[str, ...]) -> None:
        """Send changes no more; no names: of none."""
        if names:
            self._wanted.get(client, set()).difference_update(map(node.resolve, filter(is_legal_name, names)))
        else:
            self._wanted.pop(client, None)

    def forget(self, client: Connection) -> None:
        """Remove a client that has gone."""
        self._wanted.pop(client, None)

    async def refresh(self, node: Node) -> None:
        """Watch again through another node, and send what changed meanwhile."""
        if self._wanted and self._watched is not node:
            self._watched = node
            self._changed(_ALL, await node.params.watch(_ALL, self._changed))

    def _changed(self, name: str, value: object) -> None:
        """Send a parameter that changed, or those of a namespace; those below that are gone are sent without value."""
        leaves = dict(flatten(name, value)) if value != _DELETED else {}
        below = name.rstrip("/") + "/"
        gone = {known for known in self._known if known == name or known.startswith(below)} - leaves.keys()
        self._known = (self._known - gone) | leaves.keys()
        changed = [to_parameter(*leaf) for leaf in leaves.items()] + [Parameter(each) for each in sorted(gone)]
        for client, names in self._wanted.items():
            wanted = [parameter for parameter in changed if _matches(parameter.name, names)]
            if wanted:
                _send(client, wanted, None)


async def _set(node: Node, parameter: Parameter) -> object:
    """Set or delete a parameter, and return its value then.

    Raises:
        RosError: the master does not answer, or cannot hold the value.
        ValueError: the name or the value is none.
        OverflowError: no float is as large.
    """
    if not is_legal_name(parameter.name) or not parameter.name:
        raise ValueError("this is not the name of a parameter")
    if parameter.is_set:
        value = from_parameter(parameter)
        await node.params.set(parameter.name, value)
        return value
    if await node.params.has(parameter.name):
        await node.params.delete(parameter.name)
    return _DELETED


def _matches(name: str, wanted: set[str]) -> bool:
    return _ALL in wanted or name in wanted or any(name.startswith(f"{each}/") for each in wanted)


def _send(client: Connection, parameters: list[Parameter], request_id: str | None) -> None:
    client.send(ParameterValues(tuple(parameters), UNSET if request_id is None else request_id))
