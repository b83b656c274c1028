from io import BytesIO

import rospy
from geometry_msgs.msg import PointStamped
from rosgraph_msgs.msg import Clock, TopicStatistics
from wait import until


class Carrier(rospy.AnyMsg):
    """A serialized PointStamped, whose header is sent as it is."""

    _type, _md5sum, _full_text = PointStamped._type, PointStamped._md5sum, PointStamped._full_text


rospy.set_param("/use_sim_time", True)
rospy.set_param("/enable_statistics", True)
rospy.set_param("/statistics_window_min_elements", 3)
rospy.set_param("/statistics_window_max_elements", 5)
rospy.set_param("/statistics_window_min_size", 1)
rospy.set_param("/statistics_window_max_size", 4)
rospy.init_node("counted")
clock = rospy.Publisher("/clock", Clock, queue_size=1, latch=True)
statistics, received = [], []
watching = rospy.Subscriber("/statistics", TopicStatistics, statistics.append)
points = rospy.Publisher("point", Carrier, queue_size=1)
listening = rospy.Subscriber("point", PointStamped, received.append)
until(lambda: points.get_num_connections() == 1)


def at(time_s, seq, age_s):
    """Publish at a time."""
    clock.publish(rospy.Time.from_sec(time_s))
    until(lambda: rospy.get_time() == time_s)
    message, buffer = PointStamped(), BytesIO()
    message.header.seq = seq
    message.header.stamp = rospy.Time.from_sec(time_s - age_s)
    message.header.frame_id = "map" * (seq % 3)
    message.serialize(buffer)
    carrier = Carrier()
    carrier._buff = buffer.getvalue()
    count = len(received) + 1
    points.publish(carrier)
    until(lambda: len(received) == count)


at(10.0, 1, 0.25)  # its statistics are lost: no subscriber is connected yet
until(lambda: watching.get_num_connections() == 1)
for number in range(24):
    at(10.125 + number / 4 + number % 2 / 16, number + 2 + number // 5, number / 16)
for number in range(4):
    at(17.0 + 3 * number, 40 + number, 0.5)
until(lambda: any(each.window_stop.secs == 26 for each in statistics))
for each in statistics:
    if each.window_stop.secs > 10:
        values = {name: getattr(each, name) for name in each.__slots__}
        print({name: round(value.to_sec(), 6) if hasattr(value, "secs") else value for name, value in values.items()})

rospy.set_param("/enable_statistics", False)
off = rospy.Subscriber("other", PointStamped, received.append)
other = rospy.Publisher("other", PointStamped, queue_size=1)
until(lambda: other.get_num_connections() == 1)
count = len(received) + 1
other.publish()
until(lambda: len(received) == count)
print(sorted({each.topic for each in statistics}))
