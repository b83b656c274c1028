import rospy
from wait import until

rospy.init_node("tester")
events, once = [], []
timer = rospy.Timer(rospy.Duration(0.05), events.append)
single = rospy.Timer(rospy.Duration(0.05), once.append, oneshot=True)
until(lambda: len(events) >= 4 and once)
timer.shutdown()
timer.join(30)
single.join(30)
first, second = events[:2]
print(first.last_expected, first.last_real, first.last_duration, type(first.current_real).__name__)
print(
    (second.current_expected - first.current_expected).to_sec(),
    second.last_real == first.current_real,
    second.last_duration >= 0,
)
print(len(once), timer.is_alive(), timer.daemon, isinstance(timer, __import__("threading").Thread))
