"""Log of a node: stderr, and /rosout once published; thread-safe."""

import traceback
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Protocol, TextIO

from ..errors import ServiceError
from ..log import LEVELS, Level, caller, print_log
from .clock import Clock, WallClock
from .loggers import Loggers

if TYPE_CHECKING:
    from ..message_types import roscpp


class LogTopic(Protocol):
    """Publisher of /rosout."""

    @property
    def has_subscribers(self) -> bool:
        """True if there are subscribers."""
        ...

    def publish(self, message: Mapping[str, object], /) -> None:
        """Publish the fields of a rosgraph_msgs/Log."""
        ...


class NodeLog:
    """Log of one node."""

    def __init__(self, name: str, clock: Callable[[], Clock]) -> None:
        """`clock` returns the node's current clock."""
        self.name = name
        self.loggers = Loggers.for_rospy()
        """Loggers, whose level filters messages."""
        self.quiet: TextIO | None = None
        """Stream for info and debug; None: stderr."""
        self._clock = clock
        self._rosout: LogTopic | None = None
        self._topics: Callable[[], list[str]] = list

    def debug(self, text: str) -> None:
        """Log details for debugging."""
        self._write("debug", text)

    def info(self, text: str) -> None:
        """Log information."""
        self._write("info", text)

    def warn(self, text: str) -> None:
        """Log a problem with its fallback."""
        self._write("warn", text)

    def error(self, text: str) -> None:
        """Log a failure."""
        self._write("error", text)

    def fatal(self, text: str) -> None:
        """Log a failure that ends the node."""
        self._write("fatal", text)

    def exception(self, text: str, error: Exception) -> None:
        """Log an exception with its traceback."""
        trace = "".join(traceback.format_exception(error)).rstrip()
        self._write("error", f"{text}: {error}\n{trace}")

    def publish_on(self, rosout: LogTopic, topics: Callable[[], list[str]]) -> None:
        """Publish messages on /rosout from now on; `topics` returns the node's published topics."""
        self._rosout, self._topics = rosout, topics

    async def get_loggers(self, request: "roscpp.GetLoggersRequest") -> dict[str, object]:
        """Handle roscpp/GetLoggers."""
        del request
        return {"loggers": [{"name": name, "level": level} for name, level in self.loggers.levels()]}

    async def set_logger_level(self, request: "roscpp.SetLoggerLevelRequest") -> dict[str, object]:
        """Handle roscpp/SetLoggerLevel."""
        try:
            self.loggers.set(request.logger, request.level.lower())
        except ValueError as error:
            raise ServiceError(str(error)) from None
        return {}

    def _write(self, level: Level, text: str) -> None:
        if LEVELS[level] < LEVELS[self.loggers.level]:
            return
        clock = self._clock()
        now = clock.now_ns()
        wall = WallClock().now_ns()
        sim_ns = None if isinstance(clock, WallClock) else now
        print_log(level, text, wall_ns=wall, sim_ns=sim_ns, quiet=self.quiet)
        if self._rosout is not None and self._rosout.has_subscribers:
            file, function, line = caller(2)
            fields = {
                "header": {"stamp": now},
                "level": LEVELS[level],
                "name": self.name,
                "msg": text,
                "file": file,
                "function": function,
                "line": line,
                "topics": sorted(self._topics()),
            }
            self._rosout.publish(fields)
