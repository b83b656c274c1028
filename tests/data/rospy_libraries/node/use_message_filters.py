"""message_filters: Subscriber, Cache and both synchronizers."""

import threading

from geometry_msgs.msg import PointStamped
from sensor_msgs.msg import Imu
from std_msgs.msg import String

import message_filters
import rospy

rospy.init_node("filters")


def stamped(kind, stamp):
    """Message of a time."""
    m = kind()
    m.header.stamp = rospy.Time.from_sec(stamp)
    return m


class Source(message_filters.SimpleFilter):
    """Filter fed by hand."""


a, b, c = Source(), Source(), Source()
sets = []
exact = message_filters.TimeSynchronizer([a, b], 3)
exact.registerCallback(lambda *m: sets.append(("exact", [x.header.stamp.to_sec() for x in m])))
near = message_filters.ApproximateTimeSynchronizer([a, b, c], 4, 0.1)
near.registerCallback(lambda *m: sets.append(("near", [round(x.header.stamp.to_sec(), 3) for x in m])))
near.registerCallback(lambda *m: sets.append(m[-1]), "extra")
cache = message_filters.Cache(a, 5)
for stamp in (1, 2, 3, 4, 5, 6):
    a.signalMessage(stamped(PointStamped, stamp))
for stamp in (4, 2, 6, 5.05, 5.95):
    b.signalMessage(stamped(PointStamped, stamp))
for stamp in (6.04, 4.02, 7, 4.95):
    c.signalMessage(stamped(Imu, stamp))
for entry in sets:
    print(entry)
times = [m.header.stamp.to_sec() for m in cache.getInterval(rospy.Time(2), rospy.Time(4))]
print(times, cache.getLatestTime().to_sec(), cache.getOldestTime().to_sec(), cache.getLast().header.stamp.to_sec())
print(
    cache.getElemAfterTime(rospy.Time(3, 5)).header.stamp.to_sec(),
    cache.getElemBeforeTime(rospy.Time(3, 5)).header.stamp.to_sec(),
)
print(cache.getElemAfterTime(rospy.Time(30)), cache.getElemBeforeTime(rospy.Time(0)))
unordered_source = Source()
unordered = message_filters.Cache(unordered_source, 3)
for stamp in (1, 3, 2):
    unordered_source.signalMessage(stamped(PointStamped, stamp))
print(unordered.getLast().header.stamp.to_sec(), unordered.getLatestTime().to_sec())
empty = message_filters.Cache(Source())
print(empty.getLast(), empty.getOldestTime(), empty.getLatestTime())
headerless = Source()
kept, dropped = message_filters.Cache(headerless, 2, allow_headerless=True), message_filters.Cache(headerless, 2)
for word in "xyz":
    headerless.signalMessage(String(word))
print([m.data for m in kept.getInterval(kept.getOldestTime(), kept.getLatestTime())], dropped.getLast())

done = threading.Event()
first, second = (message_filters.Subscriber(name, PointStamped, queue_size=5) for name in ("/left", "/right"))
print(first.getTopic(), first.name)
both = message_filters.TimeSynchronizer([first, second], 10)
both.registerCallback(lambda x, y, word: (print(word, x.point.x, y.point.x), done.set()), "pair")
left, right = (rospy.Publisher(name, PointStamped, queue_size=5, latch=True) for name in ("/left", "/right"))
for number, publisher in enumerate((left, right)):
    m = stamped(PointStamped, 9)
    m.point.x = number
    publisher.publish(m)
print(done.wait(60))
