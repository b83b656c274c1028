"""Userdata in introspection messages: base64 of a pickle."""

import base64
import io
import pickle
from collections.abc import Mapping
from typing import Any, NoReturn


class _PlainUnpickler(pickle.Unpickler):
    """Unpickler of numbers, strings, lists and dictionaries only: a pickle of a class could run the sender's code."""

    def find_class(self, module: str, name: str) -> "NoReturn":
        raise pickle.UnpicklingError(f"userdata of the type {module}.{name} is not accepted from the network")


def encode(data: Mapping[str, Any]) -> str:
    """Encode a dictionary; values that cannot be pickled are omitted."""
    plain: dict[str, Any] = {}
    for key, value in data.items():
        try:
            pickle.dumps(value, 2)
        except Exception:  # pickling a user's class may raise anything
            continue
        plain[key] = value
    return base64.b64encode(pickle.dumps(plain, 2)).decode()


def decode(text: str) -> dict[str, Any]:
    """Decode a dictionary that `encode` encoded.

    Raises:
        ValueError: the text is damaged, or contains other values than plain data.
    """
    try:
        data: Any = _PlainUnpickler(io.BytesIO(base64.b64decode(text, validate=True))).load()
    except Exception as error:  # hostile bytes raise anything
        raise ValueError(f"userdata cannot be read: {error}") from None
    if not isinstance(data, dict):
        raise ValueError("userdata is not a dictionary")
    return data
