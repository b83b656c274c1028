"""Binary values of XML-RPC: `xmlrpc.client.Binary` in programs, bytes on the wire."""

import sys
from typing import Any


def wrap_bytes(value: Any) -> Any:
    """Copy of a value with each `bytes` wrapped in a Binary."""
    if isinstance(value, bytes):
        from xmlrpc.client import Binary  # takes long to import, and few values are binary

        return Binary(value)
    return _rebuilt(value, wrap_bytes)


def unwrap_bytes(value: Any) -> Any:
    """Copy of a value with each Binary replaced by its bytes."""
    client = sys.modules.get("xmlrpc.client")
    if client is None:  # without the module there is no Binary
        return value
    return value.data if isinstance(value, client.Binary) else _rebuilt(value, unwrap_bytes)


def _rebuilt(value: Any, convert: Any) -> Any:
    if isinstance(value, dict):
        return {name: convert(part) for name, part in value.items()}
    return [convert(part) for part in value] if type(value) in (list, tuple) else value
