import pickle

from wait import said

import genpy
import rospy

Time, Duration = rospy.Time, rospy.Duration
print(Time(1, 2), repr(Time(1, 2)), Time(1.5), Time(0, 1_500_000_000), said(Time, -1), said(Time, 1.5, 3))
print(repr(genpy.Time(1)), repr(genpy.Duration(1)), repr(Duration(-1.5)), Duration(0, -1).secs, Duration(0, -1).nsecs)
print(
    Time.from_sec(12.25),
    Time.from_seconds(2.5),
    type(Time.from_sec(1)).__module__,
    Time(5).to_sec(),
    Time(5, 6).to_nsec(),
)
print(repr(Time(5) + Duration(2)), repr(Duration(2) + Time(5)), repr(Time(5) - Duration(2)), repr(Time(5) - Time(2)))
print(
    said(lambda: Time(5) + Time(5)), said(lambda: Time(5) - 3), said(lambda: Time(5) + 3), said(lambda: 3 + Duration(1))
)
print(
    repr(Duration(3) * 2), repr(2 * Duration(3)), repr(Duration(3) * 0.5), repr(Duration(3) / 2), repr(Duration(3) // 2)
)
print(
    Duration(7) / Duration(2),
    Duration(7) // Duration(2),
    repr(Duration(7) % Duration(2)),
    divmod(Duration(7), Duration(2)),
)
print(repr(-Duration(1, 5)), repr(abs(Duration(-2))), Duration(1) == Duration(1), Duration(1) == genpy.Duration(1))
print(Time(1) == Duration(1), Time(1) != Duration(1), Time(1) == 1, Time(1) < Time(2), Time(2) >= Time(2))
print(said(lambda: Time(1) < Duration(1)), said(lambda: Time(1) < 3), said(lambda: Duration(1) > Time(1)))
print(
    bool(Time()),
    bool(Duration(1)),
    Time().is_zero(),
    Duration(0, 1).is_zero(),
    hash(Time(1, 2)) == hash(genpy.Time(1, 2)),
)
print(max(Time(1), Time(3)), sorted([Duration(3), Duration(1)]), {Time(1): "a"}[Time(1)])
value = Time(3, 4)
value.set(5, 2_000_000_000)
value.canon()
print(value.secs, value.nsecs, pickle.loads(pickle.dumps(value)), value.to_time())
print(said(Time.now), said(rospy.get_time), said(rospy.Rate, 10))
