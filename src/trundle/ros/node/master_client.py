"""Calls of one node to the master."""

from typing import Any

from ..errors import MasterError, MasterUnreachableError, WireError
from ..xmlrpc.rpc_client import call_value
from ..xmlrpc.xmlrpc import FaultError
from .pending_work import PendingWork

_MASTER_S = 5.0
"""How long the master may take for an answer."""


class MasterClient:
    """The master's XML-RPC interface, called in the name of one node."""

    def __init__(self, uri: str, caller: str, work: PendingWork) -> None:
        self._uri = uri
        self._caller = caller
        self._work = work

    async def call(self, method: str, *arguments: object) -> Any:
        """Call the master and return the value it answers with.

        Raises:
            MasterUnreachableError: nobody answers.
            MasterError: the master answers with a failure.
        """
        try:
            with self._work.pending():
                return await call_value(self._uri, method, self._caller, *arguments, timeout_s=_MASTER_S)
        except (OSError, WireError) as error:
            raise MasterUnreachableError(self._uri, str(error) or "no answer in time") from None
        except FaultError as error:
            raise MasterError(f"{method}: {error}") from None
