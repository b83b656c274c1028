"""Cache of parameters whose changes the master sends."""

import contextlib
import threading
from typing import Any

from rosgraph.binary import wrap_bytes

from .. import core, graph


class ParamServerCache:
    """Values of watched parameters by global name; {} for one that is not set."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._values: dict[str, Any] = {}

    def get(self, key: str) -> Any:
        """Value of a watched parameter.

        Raises:
            KeyError: it is not watched, or not set.
        """
        with self._lock:
            if key in self._values:
                value = self._values[key]
                if value == {}:
                    raise KeyError(key)
                return value
            raise KeyError(key)

    def set(self, key: str, value: Any) -> None:
        """Set the value of a parameter that is watched from now on."""
        with self._lock:
            self._values[key] = value

    def update(self, key: str, value: Any) -> None:
        """Set a watched parameter, or a part of one.

        Raises:
            KeyError: it is not watched.
        """
        with self._lock:
            over = [watched for watched in self._values if f"{key}/".startswith(f"{watched.rstrip('/')}/")]
            if not over:
                raise KeyError(key)
            for watched in over:
                rest = key[len(watched) :]
                self._values[watched] = _with_part(self._values[watched], rest, value) if rest else value

    def delete(self, key: str) -> None:
        """Forget a parameter.

        Raises:
            KeyError: it is not watched.
        """
        with self._lock:
            del self._values[key]


cache = ParamServerCache()


def get_param_server_cache() -> ParamServerCache:
    """Values of watched parameters."""
    return cache


def watch(name: str) -> Any:
    """Watch a parameter; returns its value, {} if it is not set."""
    node = graph.node
    if node is None:
        raise KeyError(name)
    value = wrap_bytes(graph.run(lambda: node.params.watch(name, update)))
    if not core.is_shutdown():
        cache.set(name, value)
    return value


def update(key: str, value: Any) -> None:
    """Set a parameter, or a part of one, if it is watched."""
    with contextlib.suppress(KeyError):
        cache.update(key, wrap_bytes(value))


def _with_part(tree: Any, path: str, value: Any) -> Any:
    """Copy of a parameter tree with a part replaced."""
    result = dict(tree) if isinstance(tree, dict) else {}
    folder: dict[str, Any] = result
    *folders, last = [part for part in path.split("/") if part]
    for part in folders:
        namespace = folder.get(part)
        folder[part] = dict(namespace) if isinstance(namespace, dict) else {}
        folder = folder[part]
    folder[last] = value
    return result
