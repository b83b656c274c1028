"""What C++ must know of a message type to write and read it."""

import keyword
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, TypeAlias, cast

from rosbags.interfaces import Nodetype

from trundle.built import refuse_stale

from .. import _wire
from ..errors import MessageError
from .type_definitions import PLACEHOLDER, ros_name

if TYPE_CHECKING:
    from rosbags.typesys.store import Typestore

refuse_stale(_wire)

_Fields: TypeAlias = list[tuple[str, str, int, int]]
"""Attribute, type, how many, and of a message's type its place."""
_DEEPEST = 100
"""Messages within messages; no robot's come near."""


def compile_type(store: "Typestore", key: str) -> _wire.Program:
    """Make what writes and reads messages of a type.

    Raises:
        MessageError: there can be no message of this type.
    """
    layouts: dict[str, tuple[type, _Fields]] = {}
    _add_layout(store, key, layouts, 0)
    try:
        return _wire.Program(list(layouts.values()))
    except ValueError as error:
        raise MessageError(f"there can be no {ros_name(key)}: {error}") from None


def _add_layout(store: "Typestore", key: str, layouts: dict[str, tuple[type, _Fields]], depth: int) -> int:
    """Put a type behind those its fields are of; return its place."""
    if key in layouts:
        return list(layouts).index(key)
    if depth > _DEEPEST:
        raise MessageError(f"{ros_name(key)} contains itself, or too many messages within each other")
    fields: _Fields = []
    for name, (kind, detail) in cast("Sequence[tuple[str, Any]]", store.fielddefs[key][1]):
        count = _wire.ONE
        if kind in (Nodetype.ARRAY, Nodetype.SEQUENCE):
            count = detail[1] if kind == Nodetype.ARRAY else _wire.ANY
            kind, detail = detail[0]
        attribute = f"{name}_" if keyword.iskeyword(name) else name
        if kind == Nodetype.NAME:
            fields.append((attribute, "message", count, _add_layout(store, detail, layouts, depth + 1)))
        else:
            fields.append((attribute, "nothing" if name == PLACEHOLDER else detail[0], count, 0))
    layouts[key] = store.types[key], fields
    return len(layouts) - 1
