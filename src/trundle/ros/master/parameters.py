"""The parameter tree: values at slash-separated names, namespaces as dictionaries."""

from collections.abc import Callable, Iterable, Iterator
from typing import Any, TypeAlias

from trundle.base.diagnostics import UsageError

from ..errors import ParameterError

Tree: TypeAlias = "dict[str, Any]"
Update: TypeAlias = tuple[str, str, object]
"""(subscribed key, changed key, new value); keys end with a slash."""
MAX_BYTES = 64 * 1024 * 1024
"""Limit of the whole tree [bytes]: as much as one XML-RPC answer holds, so that getParam of "/" succeeds."""
MAX_DEPTH = 90
"""Maximum depth of names and nested values together: XML-RPC carries 100 levels, and the answer takes some."""
_ITEM_BYTES = 64
"""Estimated XML-RPC size of a name or number, markup included."""


class ParameterTree:
    """Contents of the parameter server. Names are global and canonical; a missing name raises KeyError."""

    def __init__(self) -> None:
        self._root: Tree = {}
        self._bytes = 0
        """Estimated XML-RPC size of `_root`."""

    def get(self, name: str) -> Any:
        """Return a value, or a namespace as a dictionary."""
        value: Any = self._root
        for part in _parts(name):
            if not isinstance(value, dict):
                raise KeyError(name)
            value = value[part]
        return value

    def set(self, name: str, value: object) -> None:
        """Set a value, or replace a whole namespace by a dictionary; a value higher up the name becomes a namespace.

        Raises:
            ParameterError: the tree would exceed `MAX_BYTES` or `MAX_DEPTH`.
            TypeError: the root must be a dictionary.
        """
        *namespaces, last = _parts(name) or [""]
        size = self._bytes + self._growth(name, value)
        if size > MAX_BYTES:
            raise ParameterError(f"all parameters together would take {size} bytes, more than the {MAX_BYTES} accepted")
        if _is_deeper(value, MAX_DEPTH - len(_parts(name))):
            raise ParameterError(f"parameters nest deeper than {MAX_DEPTH}")
        if not last:
            if not isinstance(value, dict):
                raise TypeError("cannot set root of parameter tree to non-dictionary")
            self._root, self._bytes = value, size
            return
        self._bytes = size
        tree = self._root
        for part in namespaces:
            below = tree.get(part)
            if not isinstance(below, dict):
                below = tree[part] = {}
            tree = below
        tree[last] = value

    def delete(self, name: str) -> None:
        """Delete a value or a namespace."""
        *namespaces, last = _parts(name) or [""]
        tree: Any = self.get("/".join(namespaces))
        if not last or not isinstance(tree, dict):
            raise KeyError(name)
        self._bytes -= encoded_bytes({last: tree.pop(last)})

    def has(self, name: str) -> bool:
        """True if a value or namespace of this name exists."""
        try:
            self.get(name)
        except KeyError:
            return False
        return True

    def search(self, namespace: str, key: str) -> str | None:
        """Search for a key upwards from a namespace; the match is on the first part of the key."""
        if key.startswith("/"):
            return key if self.has(key) else None
        first = _parts(key)[0]
        namespaces = _parts(namespace)
        for count in range(len(namespaces), -1, -1):
            prefix = "/" + "/".join(namespaces[:count])
            if self.has(f"{prefix}/{first}"):
                return f"{prefix.rstrip('/')}/{key}"
        return None

    def names(self) -> list[str]:
        """Names of all values; an empty namespace has none."""
        return [name for name, value in _walk("", self._root) if not isinstance(value, dict)]

    def _growth(self, name: str, value: object) -> int:
        """Change of the tree's size [bytes] if a value is set."""
        parts = _parts(name)
        current: Any = self._root
        for depth, part in enumerate(parts):
            if not isinstance(current, dict):
                return (
                    sum(_ITEM_BYTES + len(part) for part in parts[depth:])
                    + encoded_bytes(value)
                    - encoded_bytes(current)
                )
            if part not in current:
                return sum(_ITEM_BYTES + len(part) for part in parts[depth:]) + encoded_bytes(value)
            current = current[part]
        return encoded_bytes(value) - encoded_bytes(current)


def updates(subscribed: Iterable[str], name: str, value: object) -> list[Update]:
    """Compute the update of each subscribed key when `name` is set to `value` ({} if deleted).

    A key above gets the name and value as set. A key below gets its own part of the value, or {} if the new value lacks
    it (as rosmaster does).
    """
    changed = _with_slash(name)
    inside = (
        {_with_slash(key): below for key, below in _walk(name.rstrip("/"), value)} if isinstance(value, dict) else {}
    )
    result: list[Update] = []
    for key in subscribed:
        if changed.startswith(key):
            result.append((key, changed, value))
        elif isinstance(value, dict) and key.startswith(changed):
            result.append((key, key, inside.get(key, {})))
    return result


def set_leaves(name: str, value: object, set_value: Callable[[str, object], None]) -> None:
    """Set each value of a tree separately, keeping other keys of its namespaces (as rosparam does).

    Raises:
        UsageError: a dictionary in it has keys that are not strings.
    """
    if isinstance(value, dict):
        members: dict[object, Any] = value
        if not all(isinstance(key, str) for key in members):
            raise UsageError(f"YAML dictionaries must have string keys. Invalid dictionary is:\n{members}")
        for key, below in members.items():
            set_leaves(f"{name.rstrip('/')}/{key}", below, set_value)
    else:
        set_value(name, value)


def _parts(name: str) -> list[str]:
    return [part for part in name.split("/") if part]


def encoded_bytes(value: Any) -> int:
    """Estimate the XML-RPC size of a value [bytes]."""
    if isinstance(value, dict):
        return sum(_ITEM_BYTES + len(str(key)) + encoded_bytes(below) for key, below in value.items())
    if isinstance(value, list | tuple):
        return sum(map(encoded_bytes, value))
    return _ITEM_BYTES + (len(value) if isinstance(value, str | bytes) else 0)


def _is_deeper(value: Any, levels: int) -> bool:
    """True if a value nests deeper than a number of levels."""
    if levels < 0:
        return True
    below = value.values() if isinstance(value, dict) else value if isinstance(value, list | tuple) else ()
    return any(_is_deeper(member, levels - 1) for member in below)


def _with_slash(name: str) -> str:
    return "/" if not name.strip("/") else "/" + "/".join(_parts(name)) + "/"


def _walk(prefix: str, value: Tree) -> Iterator[tuple[str, Any]]:
    for key, below in value.items():
        name = f"{prefix}/{key}"
        yield name, below
        if isinstance(below, dict):
            yield from _walk(name, below)
