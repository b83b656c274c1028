"""Loggers of a node and their levels, for rosconsole and rqt_logger_level."""

from collections.abc import Iterable
from typing import Self, cast

from ..log import LEVELS, Level

_ROSPY = ("core", "init", "internal", "registration", "rosout", "service", "tcpros", "topics")
_ROSCPP = ("ros.roscpp", "ros.roscpp.roscpp_internal", "ros.roscpp.roscpp_internal.connections", "ros.rosout")


class Loggers:
    """Levels by logger name; a logger without a level has that of its nearest ancestor.

    The node logs to the default one.
    """

    def __init__(self, default: str, others: Iterable[str]) -> None:
        self._default = default
        self._names = sorted({default, *others})
        self._levels: dict[str, Level] = {}

    @classmethod
    def for_rospy(cls) -> Self:
        """Loggers of a rospy node."""
        return cls("rosout", ("rosgraph", "rospy", *(f"rospy.{name}" for name in _ROSPY)))

    @classmethod
    def for_roscpp(cls, package: str) -> Self:
        """Loggers of a roscpp node whose logger is named after its package."""
        loggers = cls(f"ros.{package}", ("ros", *_ROSCPP, "ros.roscpp.superdebug"))
        loggers.set("ros.roscpp.superdebug", "warn")
        return loggers

    @property
    def level(self) -> Level:
        """Level of the default logger."""
        return self._level(self._default)

    def levels(self) -> list[tuple[str, Level]]:
        """Pairs (name, level) of every logger."""
        return [(name, self._level(name)) for name in self._names]

    def set(self, name: str, level: str) -> None:
        """Set the level of a logger; '' means the default one.

        Raises:
            ValueError: the level is unknown.
        """
        if level not in LEVELS:
            raise ValueError(f"no level {level!r}; levels: {', '.join(LEVELS)}")
        name = name or self._default
        self._names = sorted({*self._names, name})
        self._levels[name] = cast(Level, level)

    def _level(self, name: str) -> Level:
        while name:
            if name in self._levels:
                return self._levels[name]
            name = name.rpartition(".")[0]
        return "info"
