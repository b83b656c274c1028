"""Parts of a state that a ROS message holds: a newer message replaces an older one whose parts it all holds."""

import struct
from collections.abc import Hashable
from functools import cached_property

from .frames import Buffer

_TRANSFORM_TYPES = ("tf2_msgs/TFMessage", "tf/tfMessage")
_U32 = struct.Struct("<I")
_STAMP_BYTES = 12
"""Sequence number and stamp of a header."""
_POSE_BYTES = 56
"""Translation and rotation, seven float64."""


class MessageKeys:
    """Parts of one message, read when they are needed: the child frames of transforms, or else its publisher."""

    def __init__(self, type_name: str, caller: str, data: Buffer) -> None:
        self._type_name = type_name
        self._caller = caller
        self._data = data

    def __call__(self) -> frozenset[Hashable]:
        return self._keys

    @cached_property
    def _keys(self) -> frozenset[Hashable]:
        if self._type_name in _TRANSFORM_TYPES:
            try:
                return _child_frames(self._data)
            except (struct.error, ValueError):
                pass  # damaged; clients report it
        return frozenset((self._caller,))


def _child_frames(data: Buffer) -> frozenset[Hashable]:
    """Return the child frames of a tf2_msgs/TFMessage.

    Raises:
        struct.error, ValueError: it is damaged.
    """
    (count,) = _U32.unpack_from(data)
    if count * (_STAMP_BYTES + 2 * _U32.size + _POSE_BYTES) > len(data):
        raise ValueError("a transform is cut off")
    children: set[bytes] = set()
    at = _U32.size
    for _ in range(count):
        at += _STAMP_BYTES
        (length,) = _U32.unpack_from(data, at)
        at += _U32.size + length
        (length,) = _U32.unpack_from(data, at)
        at += _U32.size
        children.add(bytes(data[at : at + length]))
        at += length + _POSE_BYTES
    if at > len(data):
        raise ValueError("a transform is cut off")
    return frozenset(children)
