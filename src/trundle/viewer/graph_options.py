"""Which nodes of a graph have options, for the page that lets people change them."""

import asyncio
import contextlib

from trundle.ros import Node, RosError, find_reconfigurable, read_options, set_options

from .content import OptionGroup, PanelOption
from .requests import SetOption

_LOOK_S = 1.0
_ANSWER_S = 5.0


class GraphOptions:
    """Looks for nodes with options as they come and go."""

    def __init__(self, node: Node) -> None:
        """`node` asks them."""
        self._node = node
        self.groups: tuple[OptionGroup, ...] = ()

    async def watch(self) -> None:
        """Look until cancelled."""
        known: dict[str, OptionGroup] = {}
        while True:
            with contextlib.suppress(RosError):  # a master that is gone may come back
                names = await find_reconfigurable(self._node)
                known = {name: group for name, group in known.items() if name in names}
                for name in names:
                    with contextlib.suppress(RosError):  # one that went away meanwhile
                        known[name] = known.get(name) or await self._read(name)
                self.groups = tuple(known[name] for name in sorted(known))
            await asyncio.sleep(_LOOK_S)

    async def set(self, request: SetOption) -> None:
        """Change one."""
        try:
            await set_options(self._node, request.group, {request.name: request.value}, timeout_s=_ANSWER_S)
        except RosError as error:
            self._node.log.error(str(error))

    async def _read(self, name: str) -> OptionGroup:
        options = await read_options(self._node, name, timeout_s=_ANSWER_S)
        return OptionGroup(name, tuple(PanelOption(o.name, o.value, o.lower, o.upper, o.description) for o in options))
