"""XML-RPC as text: calls, responses and faults.

Replaces `xmlrpc.client`, which takes 90 ms to import (too slow for `trundle topic list`) and expands entities. Here a
document type declaration is an error, so no entity can be defined.
"""

import binascii
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias
from xml.parsers import expat

from ..errors import WireError

if TYPE_CHECKING:
    from datetime import datetime

Value: TypeAlias = "bool | int | float | str | bytes | datetime | list[Any] | dict[str, Any]"
"""Types that XML-RPC can carry; integers have 32 bits. Lists hold Values, dictionaries map names to Values."""

_MAX_DEPTH = 100
"""Nesting limit of values, against stack overflow; real parameter trees stay below 10."""
_ESCAPES = str.maketrans({"&": "&amp;", "<": "&lt;", ">": "&gt;"})


class FaultError(Exception):
    """The peer answered with a fault."""

    def __init__(self, code: int, text: str) -> None:
        super().__init__(f"{text} (fault {code})")
        self.code = code
        self.text = text


def encode_call(method: str, arguments: Sequence[object]) -> bytes:
    """Encode a call."""
    params = "".join(f"<param>{_value(a)}</param>" for a in arguments)
    name = f"<methodName>{_text(method)}</methodName>"
    return f"<?xml version='1.0'?>\n<methodCall>{name}<params>{params}</params></methodCall>".encode()


def encode_response(value: object) -> bytes:
    """Encode a response."""
    text = f"<?xml version='1.0'?>\n<methodResponse><params><param>{_value(value)}</param></params></methodResponse>"
    return text.encode()


def encode_fault(code: int, text: str) -> bytes:
    """Encode a fault."""
    fault = _value({"faultCode": code, "faultString": text})
    return f"<?xml version='1.0'?>\n<methodResponse><fault>{fault}</fault></methodResponse>".encode()


def decode_call(body: bytes) -> tuple[str, list[object]]:
    """Decode a call.

    Raises:
        WireError: the body is not an XML-RPC call.
    """
    reader = _Reader(body)
    if reader.method is None:
        raise WireError("not an XML-RPC call: no <methodName>")
    return reader.method, reader.values


def decode_response(body: bytes) -> object:
    """Decode a response.

    Raises:
        FaultError: the response is a fault.
        WireError: the body is not an XML-RPC response.
    """
    reader = _Reader(body)
    if len(reader.values) != 1:
        raise WireError(f"not an XML-RPC response: {len(reader.values)} values")
    value = reader.values[0]
    if reader.is_fault:
        fault: dict[str, Any] = value if isinstance(value, dict) else {}
        code = fault.get("faultCode")
        raise FaultError(code if isinstance(code, int) else 0, str(fault.get("faultString", "")))
    return value


def _text(text: str) -> str:
    return text.translate(_ESCAPES)


def _value(value: object, depth: int = 0) -> str:
    """Encode one value.

    Raises:
        ValueError: XML-RPC cannot carry a value of this type, size or depth.
    """
    if depth > _MAX_DEPTH:
        raise ValueError(f"values nest deeper than {_MAX_DEPTH}")
    match value:
        case bool():
            body = f"<boolean>{int(value)}</boolean>"
        case int():
            if not -(2**31) <= value < 2**31:
                raise ValueError(f"{value} does not fit the 32 bits of an XML-RPC integer")
            body = f"<int>{int(value)}</int>"
        case float():
            body = f"<double>{float(value)!r}</double>"
        case str():
            body = f"<string>{_text(value)}</string>"
        case bytes():
            body = f"<base64>{binascii.b2a_base64(value, newline=False).decode()}</base64>"
        case list() | tuple():
            items: Sequence[object] = value
            data = "".join(_value(item, depth + 1) for item in items)
            body = f"<array><data>{data}</data></array>"
        case dict():
            members: dict[object, object] = value
            parts: list[str] = []
            for name, member in members.items():
                if not isinstance(name, str):
                    raise ValueError(f"dictionary keys must be strings, got {name!r}")
                parts.append(f"<member><name>{_text(name)}</name>{_value(member, depth + 1)}</member>")
            body = f"<struct>{''.join(parts)}</struct>"
        case _:
            body = _date_element(value)
    return f"<value>{body}</value>"


def _date_element(value: object) -> str:
    from datetime import datetime  # lazy: parameters rarely hold a date

    if not isinstance(value, datetime):
        raise ValueError(f"XML-RPC cannot carry {value!r} of type {type(value).__name__}")
    return f"<dateTime.iso8601>{value:%Y%m%dT%H:%M:%S}</dateTime.iso8601>"


def _boolean(text: str) -> bool:
    if text.strip() not in ("0", "1"):
        raise WireError(f"not a boolean: {text[:40]!r}")
    return text.strip() == "1"


def _date(text: str) -> "datetime":
    from datetime import datetime

    return datetime.strptime(text.strip(), "%Y%m%dT%H:%M:%S")


def _binary(text: str) -> bytes:
    return binascii.a2b_base64(text.encode())


def _nil(text: str) -> None:
    del text


_SCALARS: dict[str, Callable[[str], Any]] = {
    "i1": int,
    "i2": int,
    "i4": int,
    "i8": int,
    "int": int,
    "boolean": _boolean,
    "double": float,
    "string": str,
    "base64": _binary,
    "dateTime.iso8601": _date,
    "nil": _nil,
}


class _Reader:
    """Parser of one document; the results are `method`, `values` and `is_fault`."""

    def __init__(self, body: bytes) -> None:
        self.method: str | None = None
        self.values: list[Any] = []
        self.is_fault = False
        self._texts: list[str] = []
        self._stack: list[list[Any] | dict[str, Any]] = []
        self._names: list[str] = []
        self._filled: list[bool] = []
        """One entry per open <value>: True once a typed element inside has set its value."""
        parser = expat.ParserCreate()
        parser.buffer_text = True
        parser.StartDoctypeDeclHandler = self._refuse
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.CharacterDataHandler = self._texts.append
        try:
            parser.Parse(body, True)
        except (expat.ExpatError, ValueError, binascii.Error, IndexError, LookupError) as error:
            raise WireError(f"not XML-RPC: {error}") from None

    def _refuse(self, *_: object) -> None:
        raise WireError("XML-RPC must not have a document type declaration")

    def _start(self, tag: str, _: dict[str, str]) -> None:
        self._texts.clear()
        if tag == "value":
            if len(self._filled) > _MAX_DEPTH:
                raise WireError(f"values nest deeper than {_MAX_DEPTH}")
            self._filled.append(False)
        elif tag == "array":
            self._stack.append([])
        elif tag == "struct":
            self._stack.append({})
        elif tag == "fault":
            self.is_fault = True

    def _end(self, tag: str) -> None:
        text = "".join(self._texts)
        self._texts.clear()
        if tag == "value":
            if not self._filled.pop():
                self._put(text)  # an untyped value is a string
        elif tag in _SCALARS:
            self._fill(_SCALARS[tag](text))
        elif tag in ("array", "struct"):
            self._fill(self._stack.pop())
        elif tag == "name":
            self._names.append(text)
        elif tag == "methodName":
            self.method = text.strip()

    def _fill(self, value: Any) -> None:
        self._filled[-1] = True
        self._put(value)

    def _put(self, value: Any) -> None:
        if not self._stack:
            self.values.append(value)
        elif isinstance(container := self._stack[-1], list):
            container.append(value)
        else:
            container[self._names.pop()] = value
