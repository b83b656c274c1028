"""XML-RPC client with the calls of `xmlrpc.client.ServerProxy`, without importing an HTTP library."""

from typing import Any

from trundle.ros.errors import WireError
from trundle.ros.xmlrpc.proxy import blocking_call
from trundle.ros.xmlrpc.xmlrpc_text import FaultError

from .binary import unwrap_bytes, wrap_bytes


class ServerProxy:
    """Client whose methods call the server's."""

    def __init__(self, uri: str, *, timeout_s: float | None = None) -> None:
        self._uri = uri
        self._timeout_s = timeout_s

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)

        def call(*arguments: Any) -> Any:
            try:
                values = [unwrap_bytes(argument) for argument in arguments]
                return wrap_bytes(blocking_call(self._uri, name, *values, timeout_s=self._timeout_s))
            except FaultError as error:
                from xmlrpc.client import Fault

                raise Fault(error.code, error.text) from None
            except ValueError as error:  # as xmlrpc.client, for None and for long integers
                raise (OverflowError if "does not fit" in str(error) else TypeError)(str(error)) from None
            except WireError as error:
                raise OSError(str(error)) from None

        return call

    def __repr__(self) -> str:
        return f"<ServerProxy for {self._uri}>"
