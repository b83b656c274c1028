"""DiagnosticStatus with the methods to fill it."""

from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

OK = DiagnosticStatus.OK
WARN = DiagnosticStatus.WARN
ERROR = DiagnosticStatus.ERROR


class DiagnosticStatusWrapper(DiagnosticStatus):
    """A status that tasks write into."""

    def summary(self, *args):
        """Set level and message: two arguments, or another status."""
        level, message = _summary(args)
        self.level, self.message = level, str(message)

    def clearSummary(self):
        """OK, without a message."""
        self.summary(OK, "")

    def mergeSummary(self, *args):
        """Take the worse level; messages are joined, but those of OK beside something worse are dropped."""
        level, message = _summary(args)
        if (level > OK) == (self.level > OK):
            self.message = f"{self.message}; {message}" if self.message else message
        elif level > self.level:
            self.message = message
        self.level = max(self.level, level)

    def add(self, key, val):
        """Add a value, as text."""
        self.values.append(KeyValue(key, str(val)))


def _summary(args):
    return (args[0].level, args[0].message) if len(args) == 1 else args
