"""diagnostic_updater: tasks, merging, frequencies, stamps, publishing."""

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PointStamped

import diagnostic_updater
import rospy

rospy.init_node("diagnosed")
arrays = []
subscriber = rospy.Subscriber("/diagnostics", DiagnosticArray, arrays.append)
updater = diagnostic_updater.Updater()
while not updater.publisher.get_num_connections():
    rospy.sleep(0.02)


def show(status):
    """One status without measured figures."""
    values = [(v.key, "#" if "." in v.value else v.value) for v in status.values]
    return (status.name, status.hardware_id, status.level, status.message, values)


def wait(count):
    """Print the next array."""
    while len(arrays) < count:
        rospy.sleep(0.02)
    for status in arrays[count - 1].status:
        print(show(status))


def good(stat):
    """Fine."""
    stat.summary(diagnostic_updater.OK, "fine")
    stat.add("n", 5)
    return stat


def bad(stat):
    """Broken."""
    stat.summary(DiagnosticStatus.ERROR, "broken")
    return stat


updater.setHardwareID("dev")
updater.add("good", good)
wait(1)
both = diagnostic_updater.CompositeDiagnosticTask("both")
both.addTask(diagnostic_updater.FunctionDiagnosticTask("a", good))
both.addTask(diagnostic_updater.FunctionDiagnosticTask("b", bad))
both.addTask(diagnostic_updater.Heartbeat())
updater.add(both)
updater.add("silent", lambda stat: stat)
updater.force_update()
wait(4)
print(updater.removeByName("silent"), updater.removeByName("silent"))
updater.broadcast(1, "all warn")
wait(5)
bounds = {"min": 0.001, "max": 1e6}
topic = rospy.Publisher("/out", PointStamped, queue_size=1)
publisher = diagnostic_updater.DiagnosedPublisher(
    topic, updater, diagnostic_updater.FrequencyStatusParam(bounds, 0.1, 10), diagnostic_updater.TimeStampStatusParam()
)
updater.removeByName("both")
updater.force_update()
message = PointStamped()
message.header.stamp = rospy.Time.now()
publisher.publish(message)
updater.force_update()
message.header.stamp = rospy.Time.now() - rospy.Duration(60)
publisher.publish(message)
message.header.stamp = rospy.Time(0)
publisher.publish(message)
updater.force_update()
wait(7)
wait(8)
wait(9)
frequency = diagnostic_updater.FrequencyStatus(diagnostic_updater.FrequencyStatusParam({"min": 1e5, "max": 1e5}))
frequency.tick()
rospy.sleep(0.01)
print(show(frequency.run(diagnostic_updater.DiagnosticStatusWrapper())))
s = diagnostic_updater.DiagnosticStatusWrapper()
for level, text in ((0, "a"), (0, "b"), (1, "c"), (0, "d"), (2, "e"), (1, "f")):
    s.mergeSummary(level, text)
    print(s.level, s.message)
s.clearSummary()
print(s.level, repr(s.message))
heard = len(arrays)
updater.update()
print(len(arrays) == heard)
