"""tf2_py.BufferCore: every lookup, every error, listings; and random trees."""

import math
import random

from geometry_msgs.msg import TransformStamped

import rospy
import tf2_py

T = rospy.Time


def put(buffer, parent, child, stamp, x, is_static=False, q=(0, 0, 0, 1)):
    """Add a transform."""
    m = TransformStamped(child_frame_id=child)
    m.header.frame_id, m.header.stamp = parent, T.from_sec(stamp)
    m.transform.translation.x = x
    r = m.transform.rotation
    r.x, r.y, r.z, r.w = q
    (buffer.set_transform_static if is_static else buffer.set_transform)(m, "auth")


def show(value):
    """Rounded content."""
    if not hasattr(value, "transform"):
        return repr(value)
    t, q = value.transform.translation, value.transform.rotation
    numbers = [round(v, 6) + 0 for v in (t.x, t.y, t.z, q.x, q.y, q.z, q.w)]
    return (value.header.frame_id, value.child_frame_id, value.header.stamp.to_nsec(), numbers)


def ask(name, *arguments):
    """Print a method's answer, or its error."""
    try:
        print(name, arguments, show(getattr(b, name)(*arguments)))
    except (tf2_py.TransformException, TypeError) as error:
        print(name, arguments, type(error).__name__, "" if isinstance(error, TypeError) else error)


b = tf2_py.BufferCore(rospy.Duration(10))
put(b, "a", "b", 1, 1)
put(b, "a", "b", 3, 2)
put(b, "b", "c", 0, 5, True, (0.5, 0.5, 0.5, 0.5))
put(b, "x", "y", 2, 1)
put(b, "a", "b", 3, 9)
put(b, "q", "q", 1, 1)
put(b, "z", "", 1, 1)
put(b, "a", "d", 1, 1)
put(b, "a", "old", 20, 1)
put(b, "a", "old", 1, 1)
for target, source, stamp in (
    ("a", "b", T(0)), ("a", "b", T(2)), ("a", "b", T(4)), ("a", "b", T(0, 5)), ("a", "c", T(2)), ("a", "nope", T(0)),
    ("nope", "a", T(0)), ("a", "y", T(0)), ("a", "y", T(2)), ("/a", "b", T(0)), ("", "b", T(0)), ("a", "d", T(1)),
    ("a", "d", T(2)), ("d", "b", T(2)), ("d", "b", T(5)), ("b", "b", T(0)), ("b", "b", T(77)), ("b", "c", T(7)),
    ("x", "a", T(9)), ("a", "y", T(9)),
):  # fmt: skip
    ask("lookup_transform_core", target, source, stamp)
    ask("can_transform_core", target, source, stamp)
ask("lookup_transform_full_core", "a", T(2), "b", T(1), "a")
ask("can_transform_full_core", "a", T(2), "b", T(9), "a")
ask("lookup_transform_full_core", "a", T(2), "b", T(1), "nope")
ask("all_frames_as_yaml")
ask("all_frames_as_string")
ask("_allFramesAsDot")
ask("_allFramesAsDot", T(30))
ask("_frameExists", "a")
print(sorted(b._getFrameStrings()))
ask("_chain", "c", T(2), "a", T(2), "a")
ask("_chain", "d", T(1), "c", T(1), "c")
for one, other in (("a", "b"), ("b", "c"), ("c", "d"), ("b", "y"), ("b", "nope"), ("b", "b")):
    ask("get_latest_common_time", one, other)
ask("set_transform", 1)
ask("lookup_transform_core", 1, 2, 3)
b.clear()
ask("all_frames_as_yaml")
ask("can_transform_core", "a", "c", T(0))
ask("can_transform_core", "b", "c", T(0))
ask("lookup_transform_core", "a", "b", T(0))
b = tf2_py.BufferCore()
ask("all_frames_as_yaml")
ask("_allFramesAsDot")
rand = random.Random(3)
parents = {"f1": "f0", "f2": "f1", "f3": "f1", "f4": "f3", "f5": "f0"}


def quaternion():
    """Any rotation."""
    q = [rand.gauss(0, 1) for _ in range(4)]
    return [v / math.hypot(*q) for v in q]


for i in range(30):
    for child, parent in parents.items():
        if child == "f3":
            if i == 0:
                put(b, parent, child, 0, rand.random(), True, quaternion())
        elif child != "f5" or i > 10:
            put(b, parent, child, 100 + i * 0.5 + rand.random() * 0.3, rand.random(), False, quaternion())
frames = [f"f{i}" for i in range(6)]
for _ in range(40):
    x, y, z = rand.choice(frames), rand.choice(frames), rand.choice(frames)
    first, second = rand.choice([0, rand.uniform(99, 118)]), rand.choice([0, rand.uniform(104, 115)])
    ask("lookup_transform_core", x, y, T.from_sec(first))
    ask("lookup_transform_full_core", x, T.from_sec(first), y, T.from_sec(second), z)
    ask("can_transform_full_core", x, T.from_sec(first), y, T.from_sec(second), z)
    ask("get_latest_common_time", x, y)
