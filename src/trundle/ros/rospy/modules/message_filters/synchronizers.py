"""Messages of several topics, put together by their stamps."""

import itertools
import threading

import rospy

from .simple_filter import SimpleFilter, stamp_of


class TimeSynchronizer(SimpleFilter):
    """Calls with one message of each filter, when all have the same stamp."""

    def __init__(self, fs, queue_size, reset=False):
        """Connect to filters.

        Args:
            fs: the filters.
            queue_size: number of messages that each may wait.
            reset: in sim time, drop what waits when the time jumps back.
        """
        super().__init__()
        self.lock = threading.Lock()
        self.queue_size = queue_size
        self.enable_reset = reset
        self.connectInput(fs)

    def connectInput(self, fs):
        """Take the messages of filters, in this order."""
        self.queues = [{} for _ in fs]
        self.latest_stamps = [rospy.Time(0)] * len(fs)
        self.input_connections = [
            each.registerCallback(self.add, queue, index)
            for index, (each, queue) in enumerate(zip(fs, self.queues, strict=True))
        ]

    def add(self, msg, my_queue, my_queue_index=None):
        """Queue a message, and call if it completes a set."""
        with self.lock:
            if not self._enqueue(msg, msg.header.stamp, my_queue, my_queue_index):
                return
            for stamp in sorted(set.intersection(*map(set, self.queues))):
                self._emit([stamp] * len(self.queues))

    def _enqueue(self, msg, stamp, queue, index):
        """Queue a message; False if others have to come first, after a jump in time."""
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

    def _note_time(self, now):
        """Overridden where all queues follow the time."""

    def _emit(self, stamps):
        messages = [queue[stamp] for queue, stamp in zip(self.queues, stamps, strict=True)]
        self.signalMessage(*messages)
        for queue, stamp in zip(self.queues, stamps, strict=True):
            del queue[stamp]


class ApproximateTimeSynchronizer(TimeSynchronizer):
    """Calls with one message of each filter, when their stamps are near each other."""

    def __init__(self, fs, queue_size, slop, allow_headerless=False, reset=False):
        """Connect to filters.

        Args:
            fs: the filters.
            queue_size: number of messages that each may wait.
            slop: largest difference of the stamps [s].
            allow_headerless: stamp messages without a header on arrival, instead of dropping them.
            reset: in sim time, drop what waits when the time jumps back.
        """
        super().__init__(fs, queue_size, reset)
        self.slop = rospy.Duration.from_sec(slop)
        self.allow_headerless = allow_headerless
        self.last_added = rospy.Time()

    def add(self, msg, my_queue, my_queue_index=None):
        """Queue a message, and call if it completes a set; the nearest in time are taken."""
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

    def _near(self, stamp, queue):
        """Stamps of a queue within the slop, nearest first."""
        within = [each for each in queue if abs(each - stamp) <= self.slop]
        return sorted(within, key=lambda each: abs(each - stamp))

    def _note_time(self, now):
        if now < self.last_added:
            rospy.loginfo("ApproximateTimeSynchronizer: the time jumped back; waiting messages are dropped")
            for queue in self.queues:
                queue.clear()
        self.last_added = now
