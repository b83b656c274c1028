"""Synchronization of several topics by the messages' stamps."""

import itertools
import threading
from collections.abc import Sequence
from typing import Any

import genpy
import rospy

from .simple_filter import SimpleFilter, stamp_of

_Queue = dict[genpy.Time, Any]


class TimeSynchronizer(SimpleFilter):
    """Calls with one message of each filter, once all have the same stamp."""

    def __init__(self, fs: Sequence[SimpleFilter], queue_size: int, reset: bool = False) -> None:
        """Connect to filters.

        Args:
            fs: sources of the messages.
            queue_size: maximum number of queued messages per filter.
            reset: in sim time, drop queued messages when the time jumps back.
        """
        super().__init__()
        self.lock = threading.Lock()
        self.queue_size = queue_size
        self.enable_reset = reset
        self.connectInput(fs)

    def connectInput(self, fs: Sequence[SimpleFilter]) -> None:
        """Receive the messages of filters, in this order."""
        self.queues: list[_Queue] = [{} for _ in fs]
        self.latest_stamps: list[genpy.Time] = [rospy.Time(0)] * len(fs)
        self.input_connections = [
            source.registerCallback(self.add, queue, index)
            for index, (source, queue) in enumerate(zip(fs, self.queues, strict=True))
        ]

    def add(self, msg: Any, my_queue: _Queue, my_queue_index: int | None = None) -> None:
        """Queue a message, and call if it completes a set."""
        with self.lock:
            if not self._enqueue(msg, msg.header.stamp, my_queue, my_queue_index):
                return
            for stamp in sorted(set.intersection(*map(set, self.queues))):
                self._emit([stamp] * len(self.queues))

    def _enqueue(self, msg: Any, stamp: genpy.Time, queue: _Queue, index: int | None) -> bool:
        """Queue a message; False after a time jump, until each queue has received a message."""
        now = rospy.Time.now()
        watches_time = self.enable_reset and not rospy.rostime.is_wallclock()
        if watches_time and index is not None:
            if now < self.latest_stamps[index]:
                queue.clear()
            self.latest_stamps[index] = now
        queue[stamp] = msg
        self._note_time(now)
        while len(queue) > self.queue_size:
            del queue[min(queue)]
        return not watches_time or max(self.latest_stamps) == now

    def _note_time(self, now: genpy.Time) -> None:
        """Clear the queues after a time jump, where a subclass does so."""

    def _emit(self, stamps: Sequence[genpy.Time]) -> None:
        messages = [queue[stamp] for queue, stamp in zip(self.queues, stamps, strict=True)]
        self.signalMessage(*messages)
        for queue, stamp in zip(self.queues, stamps, strict=True):
            del queue[stamp]


class ApproximateTimeSynchronizer(TimeSynchronizer):
    """Calls with one message of each filter, once their stamps are close."""

    def __init__(
        self,
        fs: Sequence[SimpleFilter],
        queue_size: int,
        slop: float,
        allow_headerless: bool = False,
        reset: bool = False,
    ) -> None:
        """Connect to filters.

        Args:
            fs: sources of the messages.
            queue_size: maximum number of queued messages per filter.
            slop: largest difference of the stamps [s].
            allow_headerless: stamp messages without a header on arrival, instead of dropping them.
            reset: in sim time, drop queued messages when the time jumps back.
        """
        super().__init__(fs, queue_size, reset)
        self.slop = rospy.Duration.from_sec(slop)
        self.allow_headerless = allow_headerless
        self.last_added = rospy.Time()

    def add(self, msg: Any, my_queue: _Queue, my_queue_index: int | None = None) -> None:
        """Queue a message, and call if it completes a set; the nearest stamps win."""
        stamp = stamp_of(msg, self.allow_headerless)
        if stamp is None:
            return
        with self.lock:
            if not self._enqueue(msg, stamp, my_queue, my_queue_index) or stamp not in my_queue:
                return
            candidates = [[stamp] if queue is my_queue else self._near(stamp, queue) for queue in self.queues]
            for stamps in itertools.product(*candidates):
                if max(stamps) - min(stamps) < self.slop:
                    self._emit(stamps)
                    break

    def _near(self, stamp: genpy.Time, queue: _Queue) -> list[genpy.Time]:
        """Stamps of a queue within the slop, nearest first."""
        near = [queued for queued in queue if abs(queued - stamp) <= self.slop]
        return sorted(near, key=lambda queued: abs(queued - stamp))

    def _note_time(self, now: genpy.Time) -> None:
        if now < self.last_added:
            rospy.loginfo("ApproximateTimeSynchronizer: the time jumped back; waiting messages are dropped")
            for queue in self.queues:
                queue.clear()
        self.last_added = now
