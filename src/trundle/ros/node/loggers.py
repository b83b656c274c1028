"""The loggers that a node lists for rosconsole and rqt_logger_level, each with its level."""

from collections.abc import Iterable
from typing import Self, cast

from ..log import LEVELS, Level

_ROSPY = ("core", "init", "internal", "registration", "rosout", "service", "tcpros", "topics")
_ROSCPP = ("ros.roscpp", "ros.roscpp.roscpp_internal", "ros.roscpp.roscpp_internal.connections", "ros.rosout")


class Loggers:
    """Levels by name; a logger without one of its own has that of the nearest name above it.

    All that a node says goes through one of them.
    """

    def __init__(self, own: str, others: Iterable[str]) -> None:
        self._own = own
        self._names = sorted({own, *others})
        self._levels: dict[str, Level] = {}

    @classmethod
    def for_rospy(cls) -> Self:
        """The loggers of a node in Python."""
        return cls("rosout", ("rosgraph", "rospy", *(f"rospy.{name}" for name in _ROSPY)))

    @classmethod
    def for_roscpp(cls, package: str) -> Self:
        """The loggers of a node in C++ that says what it does in the name of its package."""
        loggers = cls(f"ros.{package}", ("ros", *_ROSCPP, "ros.roscpp.superdebug"))
        loggers.set("ros.roscpp.superdebug", "warn")
        return loggers

    @property
    def level(self) -> Level:
        """What the node says at least."""
        return self._level(self._own)

    def levels(self) -> list[tuple[str, Level]]:
        """Every logger by name, with its level."""
        return [(name, self._level(name)) for name in self._names]

    def set(self, name: str, level: str) -> None:
        """Give a logger a level; one without a name is the node's own.

        Raises:
            ValueError: there is no such level.
        """
        if level not in LEVELS:
            raise ValueError(f"no level {level!r}; levels: {', '.join(LEVELS)}")
        name = name or self._own
        self._names = sorted({*self._names, name})
        self._levels[name] = cast(Level, level)

    def _level(self, name: str) -> Level:
        while name:
            if name in self._levels:
                return self._levels[name]
            name = name.rpartition(".")[0]
        return "info"
