"""Master API client of one node."""

from typing import Any

from ..errors import MasterError, MasterUnreachableError, WireError
from ..xmlrpc.rpc_client import call_value
from ..xmlrpc.xmlrpc import FaultError
from .pending_work import PendingWork

_MASTER_S = 5.0
"""Timeout of a master call."""


class MasterClient:
    """Calls the master's XML-RPC API with the node's caller ID."""

    def __init__(self, uri: str, caller: str, work: PendingWork) -> None:
        self._uri = uri
        self._caller = caller
        self._work = work

    async def call(self, method: str, *arguments: object) -> Any:
        """Call a method and return the answer's value.

        Raises:
            MasterUnreachableError: no answer.
            MasterError: the answer's code is not 1.
        """
        try:
            with self._work.pending():
                return await call_value(self._uri, method, self._caller, *arguments, timeout_s=_MASTER_S)
        except (OSError, WireError) as error:
            raise MasterUnreachableError(self._uri, str(error) or "no answer in time") from None
        except FaultError as error:
            raise MasterError(f"{method}: {error}") from None
