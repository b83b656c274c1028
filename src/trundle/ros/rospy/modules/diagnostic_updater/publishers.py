"""Diagnostics of topics."""

from .tasks import CompositeDiagnosticTask
from .topic_status import FrequencyStatus, TimeStampStatus


class HeaderlessTopicDiagnostic(CompositeDiagnosticTask):
    """Watches how often `tick` is called."""

    def __init__(self, name, diag, freq):
        """Add itself to an Updater.

        Args:
            name: topic's name.
            diag: the Updater.
            freq: FrequencyStatusParam.
        """
        super().__init__(f"{name} topic status")
        self.diag = diag
        self.freq = FrequencyStatus(freq)
        self.addTask(self.freq)
        self.diag.add(self)

    def tick(self):
        """Count a message."""
        self.freq.tick()

    def clear_window(self):
        """Start to count again."""
        self.freq.clear()


class TopicDiagnostic(HeaderlessTopicDiagnostic):
    """Watches stamps too."""

    def __init__(self, name, diag, freq, stamp):
        """Add itself to an Updater; `stamp` is a TimeStampStatusParam."""
        super().__init__(name, diag, freq)
        self.stamp = TimeStampStatus(stamp)
        self.addTask(self.stamp)

    def tick(self, stamp):
        """Count a message with a stamp."""
        self.stamp.tick(stamp)
        super().tick()


class DiagnosedPublisher(TopicDiagnostic):
    """Publishes and watches."""

    def __init__(self, pub, diag, freq, stamp):
        """Wrap a rospy.Publisher of messages with a header."""
        super().__init__(pub.name, diag, freq, stamp)
        self.publisher = pub

    def publish(self, message):
        """Publish a message."""
        self.tick(message.header.stamp)
        self.publisher.publish(message)
