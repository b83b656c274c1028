from wait import said

from geometry_msgs.msg import Point, PoseStamped, Quaternion, Twist, Vector3
from std_msgs.msg import ColorRGBA, Empty, Float32MultiArray, Header, Int32, String

print(said(String), said(String, "a"), said(String, data="b"), said(String, None))
print(said(Point, 1, 2, 3), said(Point, x=1), said(Point, 1, 2))
print(said(Point, 1, y=2), said(Point, z=1, w=2))
print(said(Twist, Vector3(1, 2, 3), Vector3(0, 0, 1)))
print(said(Twist, linear=Vector3(x=5)), said(Twist, linear=None))
print(said(Empty), said(Empty, 1))
print(said(ColorRGBA, 1, 1, 1, 0.5))
print(said(PoseStamped).pose.orientation, said(Header, 1, None, "f"))
print(Quaternion().__slots__, Quaternion._slot_types, Float32MultiArray.__slots__, Float32MultiArray._slot_types)
print(repr(Int32(3)), str(Int32(3)), Int32.__name__, Int32.__module__)
a, b = Twist(), Twist()
a.linear.x = 1
print(a == b, a != b, b == Twist(), a == "x", Twist().linear is Twist().linear)
