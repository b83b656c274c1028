import io

from wait import said

from geometry_msgs.msg import Point, Pose, PoseStamped, Twist
from sensor_msgs.msg import CameraInfo, Image, JointState, LaserScan
from std_msgs.msg import Bool, Float64, Header, Int8, Int32, String, Time, UInt8, UInt32


def wrong(message):
    text = str(said(message.serialize, io.BytesIO()))
    # What `struct` says about a value differs between versions of Python.
    print(type(message).__name__, text.partition(" when writing")[0] if "<class" not in text else text.split(":")[0])


wrong(String(3))
wrong(String(["a"]))
wrong(Int32("a"))
wrong(Int32(2.5))
wrong(Int32(2**31))
wrong(Int8(200))
wrong(UInt8(-1))
wrong(UInt8(256))
wrong(UInt32(-5))
wrong(Float64("1.0"))
wrong(Float64([1]))
wrong(Time(5))
wrong(Point(1, "b", 3))
wrong(Pose(position=Point(x="a")))
wrong(JointState(position=["a"]))
wrong(JointState(name=[1]))
wrong(JointState(name="ab", position=[1.0]))
wrong(LaserScan(ranges=5))
wrong(Image(data=[300]))
wrong(Header(seq="a"))
wrong(PoseStamped(header=Header(frame_id=5)))
print(str(said(CameraInfo(K=[1.0]).serialize, io.BytesIO())).partition(":")[0])
message = Twist()
message.linear = 5
print(type(said(message.serialize, io.BytesIO())).__name__)
