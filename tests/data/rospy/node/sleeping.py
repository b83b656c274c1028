import time

import rospy
from wait import said

rospy.init_node("tester")
begin = time.time()
rospy.sleep(0.2)
rospy.sleep(rospy.Duration(0.2))
rospy.sleep(-5)
print(time.time() - begin >= 0.4)
rate = rospy.Rate(20)
begin = time.time()
for _ in range(10):
    rate.sleep()
print(
    time.time() - begin >= 0.45,
    rate.sleep_dur.to_sec(),
    type(rate.remaining()).__name__,
    rate.remaining().to_sec() <= 0.05,
)
print(said(rospy.Rate, 0), type(rospy.Time.now()).__name__, abs(rospy.get_time() - time.time()) < 60)
print(rospy.get_rostime().__class__.__module__, rospy.rostime.is_wallclock(), rospy.rostime.is_rostime_initialized())
