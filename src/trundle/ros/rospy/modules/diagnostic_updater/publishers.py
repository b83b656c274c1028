"""Diagnostics of topics."""

from typing import TYPE_CHECKING, Any

from .tasks import CompositeDiagnosticTask
from .topic_status import FrequencyStatus, FrequencyStatusParam, TimeStampStatus, TimeStampStatusParam

if TYPE_CHECKING:
    import genpy
    import rospy

    from .updater import Updater


class HeaderlessTopicDiagnostic(CompositeDiagnosticTask):
    """Checks the frequency of messages."""

    def __init__(self, name: str, diag: "Updater", freq: FrequencyStatusParam) -> None:
        """Add itself to an Updater.

        Args:
            name: topic's name.
            diag: updater that runs the task.
            freq: limits of the frequency.
        """
        super().__init__(f"{name} topic status")
        self.diag = diag
        self.freq = FrequencyStatus(freq)
        self.addTask(self.freq)
        self.diag.add(self)

    def tick(self) -> None:
        """Count a message."""
        self.freq.tick()

    def clear_window(self) -> None:
        """Restart counting."""
        self.freq.clear()


class TopicDiagnostic(HeaderlessTopicDiagnostic):
    """Checks the frequency and the stamps of messages."""

    def __init__(self, name: str, diag: "Updater", freq: FrequencyStatusParam, stamp: TimeStampStatusParam) -> None:
        """Add itself to an Updater; `stamp` is a TimeStampStatusParam."""
        super().__init__(name, diag, freq)
        self.stamp = TimeStampStatus(stamp)
        self.addTask(self.stamp)

    def tick(self, stamp: "genpy.Time | float") -> None:  # pyright: ignore[reportIncompatibleMethodOverride]
        """Count a message with a stamp."""
        self.stamp.tick(stamp)
        super().tick()


class DiagnosedPublisher(TopicDiagnostic):
    """Publishes messages, and checks their frequency and stamps."""

    def __init__(
        self, pub: "rospy.Publisher", diag: "Updater", freq: FrequencyStatusParam, stamp: TimeStampStatusParam
    ) -> None:
        """Wrap a rospy.Publisher of messages with a header."""
        super().__init__(pub.name, diag, freq, stamp)
        self.publisher = pub

    def publish(self, message: Any) -> None:
        """Publish a message."""
        self.tick(message.header.stamp)
        self.publisher.publish(message)
