"""Status messages to one client, and log lines about it."""

from collections.abc import Callable
from typing import Literal, Protocol

_LEVELS = {"none": 0, "error": 1, "warning": 2, "info": 3}
_MAX_LOGGED = 200
"""Maximum number of log lines per client, against repeating errors."""

Level = Literal["error", "warning", "info"]


class Log(Protocol):
    """The node's log."""

    def info(self, text: str) -> None: ...

    def warn(self, text: str) -> None: ...

    def error(self, text: str) -> None: ...


class Status:
    """Reports up to a level set by the client."""

    def __init__(self, number: int, log: Log, send: Callable[[dict[str, object]], None]) -> None:
        self._number = number
        self._log = log
        self._send = send
        self._level = _LEVELS["error"]
        self._logged = 0

    def set_level(self, level: object) -> None:
        """Set the level: none, error, warning or info; others are ignored, as specified."""
        if isinstance(level, str):
            self._level = _LEVELS.get(level, self._level)

    def report(self, level: Level, text: str, key: object = None) -> None:
        """Log a text, and send it if the client's level includes it."""
        self._write(
            level, f"[Client {self._number}] {text}" if key is None else f"[Client {self._number}] [id: {key}] {text}"
        )
        if _LEVELS[level] <= self._level:
            message: dict[str, object] = {"op": "status", "level": level, "msg": text}
            self._send(message if key is None else {**message, "id": key})

    def _write(self, level: Level, text: str) -> None:
        self._logged += 1
        if self._logged == _MAX_LOGGED:
            self._log.warn(f"[Client {self._number}] more than {_MAX_LOGGED} lines; further ones are not logged")
        if self._logged < _MAX_LOGGED:
            write = {"error": self._log.error, "warning": self._log.warn, "info": self._log.info}[level]
            write(text)
