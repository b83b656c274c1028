"""XML-RPC client with the calls of `xmlrpc.client.ServerProxy`, without importing an HTTP library."""

from typing import Any

from trundle.ros.errors import WireError
from trundle.ros.xmlrpc.proxy import blocking_call
from trundle.ros.xmlrpc.xmlrpc import FaultError

_TIMEOUT_S = 60.0


class ServerProxy:
    """Calls a server's methods as its own."""

    def __init__(self, uri: str) -> None:
        self._uri = uri

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)

        def call(*arguments: Any) -> Any:
            try:
                return blocking_call(self._uri, name, *arguments, timeout_s=_TIMEOUT_S)
            except FaultError as error:
                from xmlrpc.client import Fault

                raise Fault(1, str(error)) from None
            except ValueError as error:  # as of xmlrpc.client, for None and for long integers
                raise (OverflowError if "32" in str(error) else TypeError)(str(error)) from None
            except WireError as error:
                raise OSError(str(error)) from None

        return call

    def __repr__(self) -> str:
        return f"<ServerProxy for {self._uri}>"
