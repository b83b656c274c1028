"""topic_tools/relay: one topic passed on as another."""

import asyncio

from trundle.ros import Node, Settings

from ..host import Host
from .passing import Inlet, Outlet

_USAGE = "usage: relay IN_TOPIC [OUT_TOPIC]"
_LOOK_S = 0.1


class Relay:
    """Passes on every message; with ~lazy only while somebody listens."""

    def __init__(self, node: Node, arguments: list[str], host: Host) -> None:
        del host
        self._node = node
        self._arguments = arguments

    async def run(self) -> int:
        """Relay until cancelled."""
        node = self._node
        if not 1 <= len(self._arguments) <= 2:
            node.log_error(f"{_USAGE}; got {' '.join(self._arguments)!r}")
            return 1
        source, target = (*self._arguments, f"{self._arguments[0]}_relay")[:2]
        outlet = Outlet(node, target)
        inlet = Inlet(node, source, outlet.put)
        inlet.open()
        lazy = Settings(await node.get_param("~", {}), node.name).flag("lazy", default=False)
        if not lazy:
            await node.closed.wait()
            return 0
        while not node.closed.is_set():
            if outlet.wanted:
                inlet.open()
            else:
                inlet.close()
            await asyncio.sleep(_LOOK_S)
        return 0
