import io

from wait import said

import genpy
from geometry_msgs.msg import Polygon, Point32, PoseArray, Pose, TransformStamped
from sensor_msgs.msg import CameraInfo, Image, JointState, LaserScan
from std_msgs.msg import (
    Bool, Byte, ByteMultiArray, Char, Duration, Float32, Float32MultiArray, Float64, Header, Int8, Int16MultiArray, Int64,
    MultiArrayDimension, MultiArrayLayout, String, Time, UInt8MultiArray, UInt16, UInt64,
)  # fmt: skip


def round_trip(message):
    buff = io.BytesIO()
    message.serialize(buff)
    data = buff.getvalue()
    back = type(message)().deserialize(data)
    print(type(message).__name__, data.hex())
    for name in message.__slots__:
        value = getattr(back, name)
        print("  ", name, type(value).__name__, value if not isinstance(value, genpy.Message) else "…")
    return back


layout = MultiArrayLayout([MultiArrayDimension("x", 2, 2)], 0)
for message in (
    Bool(True), Bool(0), Byte(-3), Char(200), Int8(-5), Int64(-(2**60)), UInt64(2**63), UInt16(7), Float32(0.1), Float64(1),
    String("grün ✓"), String(""), Time(genpy.Time(5, 6)), Duration(genpy.Duration(-5, 6)),
    Float32MultiArray(layout, [1, 2.5]), Int16MultiArray(layout, (3, -4)), ByteMultiArray(layout, [-1, 2]),
    UInt8MultiArray(layout, b"\x01\x02"), UInt8MultiArray(layout, [3, 4]),
    Polygon([Point32(1, 2, 3)]), PoseArray(Header(1, genpy.Time(2), "map"), [Pose(), Pose()]),
    JointState(name=["a", "b"], position=[1, 2], velocity=(0.5,)), LaserScan(ranges=[float("inf"), 1.0]),
    Image(height=1, width=2, encoding="rgb8", data=bytes(6)), CameraInfo(K=[1.0] * 9, D=[0.1]), TransformStamped(),
):  # fmt: skip
    round_trip(message)
print(said(CameraInfo().deserialize, b"abc").partition(":")[0])
