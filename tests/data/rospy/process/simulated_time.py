import threading
import time

import rosgraph
import rospy
from rosgraph_msgs.msg import Clock
from wait import said, until

rosgraph.Master("/x").setParam("/use_sim_time", True)
rospy.init_node("simulated")
clock = rospy.Publisher("/clock", Clock, queue_size=10)
print(rospy.Time.now(), rospy.get_time(), rospy.rostime.is_wallclock())
until(lambda: clock.get_num_connections() == 1)


def set_time(seconds):
    clock.publish(rospy.Time.from_sec(seconds))
    until(lambda: rospy.get_time() == seconds)


def in_thread(function, *arguments):
    results = []
    thread = threading.Thread(target=lambda: results.append(said(function, *arguments)))
    thread.start()
    return thread, results


thread, results = in_thread(rospy.sleep, 5)
time.sleep(0.3)
set_time(10.0)
time.sleep(0.8)
set_time(14.9)
time.sleep(0.3)
print(thread.is_alive(), rospy.Time.now())
set_time(15.5)
thread.join(60)
print(results)
thread, results = in_thread(rospy.sleep, 100)
time.sleep(0.3)
set_time(3.0)
thread.join(60)
print(results, rospy.get_time())
rate = rospy.Rate(1)
thread, results = in_thread(rate.sleep)
time.sleep(0.3)
set_time(2.0)
thread.join(60)
print(results)
calm = rospy.Rate(1, reset=True)
thread, results = in_thread(calm.sleep)
time.sleep(0.3)
set_time(1.0)
thread.join(60)
print(results)
events = []
timer = rospy.Timer(rospy.Duration(1), events.append)
time.sleep(0.3)
for step in range(8):
    set_time(1.5 + step / 2)
    time.sleep(0.1)
until(lambda: len(events) >= 3)
print(events[0].current_expected, events[1].last_expected)
thread, results = in_thread(rospy.sleep, 100)
time.sleep(0.3)
rospy.signal_shutdown("end")
thread.join(60)
print(results)
rosgraph.Master("/x").deleteParam("/use_sim_time")
