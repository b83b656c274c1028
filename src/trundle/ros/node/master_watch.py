"""Registration of a node at a master that was started again."""

import asyncio
from typing import Protocol

from ..errors import MasterError, RosError
from ..xmlrpc.rpc_client import call_value
from ..xmlrpc.xmlrpc_text import FaultError
from .node_context import NodeContext

_PERIOD_S = 5.0
"""Time between two questions."""


class Registered(Protocol):
    """Endpoints and parameters of a node."""

    async def wait_registered(self) -> None:
        """Wait until everything added so far is registered."""
        ...

    def register_again(self) -> None:
        """Register everything that is there."""
        ...


async def watch_master(node: NodeContext, registered: Registered) -> None:
    """Ask the master from time to time if it knows the node, and register it again if not.

    Nodes of ROS 1 are connected to each other and go on without a master; one that was killed and started again knows
    none of them. Calls are no work of the graph, which may be idle meanwhile.
    """
    is_gone = False
    while True:
        await asyncio.sleep(_PERIOD_S)
        await registered.wait_registered()
        try:
            await call_value(node.master_uri, "lookupNode", node.name, node.name)
        except MasterError:
            if is_gone:
                node.log.warn(f"the master at {node.master_uri} is back; {node.name} registers again")
            registered.register_again()
        except FaultError:
            pass  # not a master that could tell
        except (OSError, RosError) as error:
            if not is_gone:
                reason = str(error) or "no answer in time"
                node.log.warn(f"no ROS master answers at {node.master_uri} ({reason}); {node.name} goes on without it")
            is_gone = True
            continue
        is_gone = False
