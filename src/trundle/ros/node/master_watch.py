"""Registration of a node at a master that was started again."""

import asyncio
from typing import Protocol

from ..errors import MasterError, RosError
from ..xmlrpc.rpc_client import call_value
from ..xmlrpc.xmlrpc_text import FaultError
from .node_context import NodeContext

_PERIOD_S = 5.0
"""Interval of the look-ups."""


class Registered(Protocol):
    """Endpoints and parameters of a node."""

    async def wait_registered(self) -> None:
        """Wait until everything added so far is registered."""
        ...

    def register_again(self) -> None:
        """Register everything again."""
        ...


async def watch_master(node: NodeContext, registered: Registered) -> None:
    """Look up the node at the master periodically, and register it again if it is missing.

    ROS 1 nodes stay connected to each other without a master; a restarted master has none of their registrations. The
    look-ups are not tracked as work in progress, so that the graph may be idle meanwhile.
    """
    is_unreachable = False
    while True:
        await asyncio.sleep(_PERIOD_S)
        await registered.wait_registered()
        try:
            await call_value(node.master_uri, "lookupNode", node.name, node.name)
        except MasterError:
            if is_unreachable:
                node.log.warn(f"the master at {node.master_uri} is back; {node.name} registers again")
            registered.register_again()
        except FaultError:
            pass  # a master without lookupNode
        except (OSError, RosError) as error:
            if not is_unreachable:
                reason = str(error) or "no answer in time"
                node.log.warn(f"no ROS master answers at {node.master_uri} ({reason}); {node.name} goes on without it")
            is_unreachable = True
            continue
        is_unreachable = False
