"""Messages whose arrays of numbers are numpy arrays."""

from functools import cache
from typing import Any

import numpy


@cache
def numpy_msg(msg_type: Any) -> Any:
    """Class of a message type with numpy arrays; one class per type."""

    def serialize(self: Any, buff: Any) -> Any:
        return self.serialize_numpy(buff, numpy)

    def deserialize(self: Any, str: bytes) -> Any:
        return self.deserialize_numpy(str, numpy)

    methods = {"serialize": serialize, "deserialize": deserialize, "_numpy_module": numpy, "__slots__": []}
    numpy_type: Any = type(f"Numpy_{msg_type._type.replace('/', '__')}", (msg_type,), methods)
    numpy_type.__slots__ = msg_type.__slots__
    return numpy_type
