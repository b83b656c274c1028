import genpy
from genpy.message import strify_message
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from geometry_msgs.msg import PoseArray, Pose, Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Image, JointState
from std_msgs.msg import Bool, Float64, Header, String, Time

status = DiagnosticStatus(1, "a: b", "multi\nline", "", [KeyValue("k", "v"), KeyValue()])
for message in (
    String("x"), String(""), String("a: 'b' \"c\"\n"), Bool(True), Float64(1e-7), Float64(float("nan")), Twist(),
    Odometry(), PoseArray(poses=[Pose(), Pose()]), Image(data=b"\x01\x02"), Time(genpy.Time(1, 2)),
    JointState(name=["a", "b: c"], position=[1, 2.5]), DiagnosticArray(Header(), [status]),
):  # fmt: skip
    print(message)
    print(repr(message) == str(message))
print(strify_message(Twist(), fixed_numeric_width=8))
print(strify_message(Header(stamp=genpy.Time(5, 6)), time_offset=genpy.Time(2)))
print(
    strify_message([1, 2]), strify_message(["a", "b"]), strify_message([]), strify_message(True), strify_message(None)
)
print(strify_message(Odometry(), field_filter=lambda m: [n for n in m.__slots__ if n != "covariance"]))
