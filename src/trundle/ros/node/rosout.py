"""What a node says: on stderr, and on /rosout once somebody gathers it. Any thread may speak."""

import traceback
from typing import Any, TextIO

from ..errors import ServiceError
from ..log import LEVELS, Level, caller, print_log
from ..messages.messages import Message
from .clock import Clock, WallClock
from .loggers import Loggers
from .publisher import Publisher


class NodeLog:
    """The log of one node."""

    name: str
    clock: Clock
    loggers: Loggers
    """By which messages are said or not."""
    quiet_log: TextIO | None
    """Takes what is no warning in place of stderr; None: stderr has it all."""
    _rosout: Publisher | None
    _publishers: dict[str, Publisher]

    def log_debug(self, text: str) -> None:
        """Say something for whoever looks into this node."""
        self._log("debug", text)

    def log_info(self, text: str) -> None:
        """Say something everyone may want to know."""
        self._log("info", text)

    def log_warn(self, text: str) -> None:
        """Say that something is not as it should be, and what is done instead."""
        self._log("warn", text)

    def log_error(self, text: str) -> None:
        """Say that something failed."""
        self._log("error", text)

    def log_fatal(self, text: str) -> None:
        """Say why the node cannot go on."""
        self._log("fatal", text)

    def log_failure(self, what: str, error: Exception) -> None:
        """Say that code of this node raised, with where."""
        where = "".join(traceback.format_exception(error)).rstrip()
        self._log("error", f"{what}: {error}\n{where}")

    def _log(self, level: Level, text: str) -> None:
        if LEVELS[level] < LEVELS[self.loggers.level]:
            return
        now = self.clock.now_ns()
        wall = WallClock().now_ns()
        sim_ns = None if isinstance(self.clock, WallClock) else now
        print_log(level, text, wall_ns=wall, sim_ns=sim_ns, quiet=self.quiet_log)
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
                "topics": sorted(self._publishers),
            }
            self._rosout.publish(fields)

    def _get_loggers(self, request: Message) -> dict[str, Any]:
        del request
        return {"loggers": [{"name": name, "level": level} for name, level in self.loggers.levels()]}

    def _set_logger_level(self, request: Message) -> dict[str, Any]:
        try:
            self.loggers.set(request.logger, request.level.lower())
        except ValueError as error:
            raise ServiceError(str(error)) from None
        return {}
