"""DiagnosticStatus with the methods to fill it."""

from typing import Any

from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

OK = DiagnosticStatus.OK
WARN = DiagnosticStatus.WARN
ERROR = DiagnosticStatus.ERROR


class DiagnosticStatusWrapper(DiagnosticStatus):
    """A status that tasks fill."""

    def summary(self, *args: Any) -> None:
        """Set level and message: two arguments, or another status."""
        level, message = _summary(args)
        self.level, self.message = level, str(message)

    def clearSummary(self) -> None:
        """OK, without a message."""
        self.summary(OK, "")

    def mergeSummary(self, *args: Any) -> None:
        """Set the worse level; messages are joined, but messages of OK are dropped where the other level is worse."""
        level, message = _summary(args)
        if (level > OK) == (self.level > OK):
            self.message = f"{self.message}; {message}" if self.message else message
        elif level > self.level:
            self.message = message
        self.level = max(self.level, level)

    def add(self, key: str, val: object) -> None:
        """Add a value, as text."""
        self.values.append(KeyValue(key, str(val)))


def _summary(args: tuple[Any, ...]) -> tuple[int, str]:
    level, message = (args[0].level, args[0].message) if len(args) == 1 else args
    return level, message
