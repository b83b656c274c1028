"""Fragments: long messages in parts, in both directions."""

import itertools
import json
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from .errors import RosbridgeError

_MAX_PARTS = 100_000
_MAX_LISTS = 100
_MAX_CHARACTERS = 64 * 1024 * 1024
"""Limit for all incomplete messages of a client."""


@dataclass(slots=True)
class _Parts:
    total: int
    changed_s: float
    texts: dict[int, str] = field(default_factory=dict[int, str])


class Reassembly:
    """Incomplete messages of one client."""

    def __init__(self, timeout_s: float) -> None:
        self._timeout_s = timeout_s
        self._lists: dict[str, _Parts] = {}
        self._characters = 0

    def add(self, message: Mapping[str, object]) -> str | None:
        """Add a fragment; returns the message once it is complete.

        Raises:
            RosbridgeError: not a fragment, or inconsistent with the others.
        """
        key, number, total, text = (message.get(name) for name in ("id", "num", "total", "data"))
        if not isinstance(number, int) or not isinstance(total, int) or not isinstance(text, str) or key is None:
            raise RosbridgeError("received invalid fragment!")
        self._drop_old()
        parts = self._lists.get(str(key))
        if parts is None:
            if not 0 < total <= _MAX_PARTS or len(self._lists) >= _MAX_LISTS:
                raise RosbridgeError("received invalid fragment!")
            parts = self._lists[str(key)] = _Parts(total, time.monotonic())
        if number in parts.texts or not 0 <= number < parts.total or total != parts.total:
            raise RosbridgeError(f"error while trying to append fragment {number}")
        if self._characters + len(text) > _MAX_CHARACTERS:
            self._remove(str(key))
            raise RosbridgeError(f"fragments hold more than {_MAX_CHARACTERS} characters; the message is dropped")
        parts.texts[number] = text
        parts.changed_s = time.monotonic()
        self._characters += len(text)
        if len(parts.texts) < parts.total:
            return None
        self._remove(str(key))
        return "".join(parts.texts[index] for index in range(parts.total))

    def _remove(self, key: str) -> None:
        self._characters -= sum(map(len, self._lists.pop(key).texts.values()))

    def _drop_old(self) -> None:
        now = time.monotonic()
        for key in [key for key, parts in self._lists.items() if now - parts.changed_s > self._timeout_s]:
            self._remove(key)


_numbers = itertools.count()


def split(text: str, size: int, key: object) -> Iterator[str]:
    """Split a message into fragments of `size` characters, or more to limit their number."""
    size = max(size, -(-len(text) // _MAX_PARTS))
    key = next(_numbers) if key is None else key
    total = -(-len(text) // size)
    for number in range(total):
        data = text[number * size : (number + 1) * size]
        yield json.dumps({"op": "fragment", "id": key, "data": data, "num": number, "total": total})
