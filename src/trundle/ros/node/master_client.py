"""Master API client of one node."""

from typing import Any

from trundle.base.shortage import shortage

from ..errors import MasterError, MasterUnreachableError, WireError
from ..xmlrpc.rpc_client import call_value
from ..xmlrpc.xmlrpc_text import FaultError
from .pending_work import PendingWork


class MasterClient:
    """Calls the master's XML-RPC API with the node's caller ID."""

    def __init__(self, uri: str, caller: str, work: PendingWork) -> None:
        self._uri = uri
        self._caller = caller
        self._work = work

    async def call(self, method: str, *arguments: object) -> Any:
        """Call a method and return the answer's value, however long it takes.

        Raises:
            MasterUnreachableError: the connection is refused, or breaks.
            MasterError: the answer's code is not 1.
        """
        with self._work.pending(f"the answer of the ROS master at {self._uri} to {method}"):
            return await self.poll(method, *arguments)

    async def poll(self, method: str, *arguments: object) -> Any:
        """As `call`, for polling: it is not tracked as work in progress, for which a run in lockstep waits.

        On a slow machine a pass of the loop takes longer than the poll interval, so that work would always be pending.
        """
        try:
            return await call_value(self._uri, method, self._caller, *arguments)
        except (OSError, WireError) as error:
            raise MasterUnreachableError(self._uri, shortage(error) or str(error)) from None
        except FaultError as error:
            raise MasterError(f"{method}: {error}") from None
