"""Layouts of message types for the C++ reader and writer."""

import keyword
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, TypeAlias, cast

from rosbags.interfaces import Nodetype

from trundle.base.built import refuse_stale

from .. import _message_codec
from ..errors import MessageError
from .type_definitions import PLACEHOLDER, ros_name

if TYPE_CHECKING:
    from rosbags.typesys.store import Typestore

refuse_stale(_message_codec)

_Fields: TypeAlias = list[tuple[str, str, int, int]]
"""Attribute, type, element count, and index of the layout for a nested message."""
_MAX_DEPTH = 100
"""Limit of nested messages, far above real types."""


def compile_type(store: "Typestore", key: str) -> _message_codec.MessageCodec:
    """Compile a type to a codec that reads and writes its messages.

    Raises:
        MessageError: the type has no finite layout.
    """
    layouts: dict[str, tuple[type, _Fields]] = {}
    _add_layout(store, key, layouts, 0)
    try:
        return _message_codec.MessageCodec(list(layouts.values()))
    except ValueError as error:
        raise MessageError(f"{ros_name(key)} has no layout: {error}") from None


def _add_layout(store: "Typestore", key: str, layouts: dict[str, tuple[type, _Fields]], depth: int) -> int:
    """Append the layout of a type after those of its fields' types; returns its index."""
    if key in layouts:
        return list(layouts).index(key)
    if depth > _MAX_DEPTH:
        raise MessageError(f"{ros_name(key)} contains itself, or nests too many messages")
    fields: _Fields = []
    for name, (kind, detail) in cast("Sequence[tuple[str, Any]]", store.fielddefs[key][1]):
        count = _message_codec.SCALAR
        if kind in (Nodetype.ARRAY, Nodetype.SEQUENCE):
            count = detail[1] if kind == Nodetype.ARRAY else _message_codec.VARIABLE
            kind, detail = detail[0]
        attribute = f"{name}_" if keyword.iskeyword(name) else name
        if kind == Nodetype.NAME:
            fields.append((attribute, "message", count, _add_layout(store, detail, layouts, depth + 1)))
        else:
            fields.append((attribute, "placeholder" if name == PLACEHOLDER else detail[0], count, 0))
    layouts[key] = store.types[key], fields
    return len(layouts) - 1
