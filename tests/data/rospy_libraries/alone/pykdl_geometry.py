"""PyKDL's geometry: vectors, rotations, frames, twists, wrenches, their differences and texts."""

import copy
import math
import pickle
import random

import PyKDL
from PyKDL import Frame, Rotation, Twist, Vector, Wrench

rand = random.Random(4)


def show(value):
    """Round numbers, at any depth."""
    if isinstance(value, float):
        return round(value, 6) + 0.0
    if isinstance(value, tuple):
        return tuple(show(each) for each in value)
    if isinstance(value, Rotation):
        return [[show(value[r, c]) for c in range(3)] for r in range(3)]
    if isinstance(value, Frame):
        return [[show(value[r, c]) for c in range(4)] for r in range(3)]
    if isinstance(value, Vector):
        return [show(value[i]) for i in range(3)]
    if isinstance(value, Twist | Wrench):
        return [show(value[i]) for i in range(6)]
    return value


def vector():
    """Any vector."""
    return Vector(rand.uniform(-2, 2), rand.uniform(-2, 2), rand.uniform(-2, 2))


for _ in range(3):
    r, s = Rotation.RPY(*vector()), Rotation.Rot(vector(), rand.uniform(-4, 4))
    f, g = Frame(r, vector()), Frame(s, vector())
    t, w = Twist(vector(), vector()), Wrench(vector(), vector())
    v, u = vector(), vector()
    for value in (
        r * s, r * v, r * t, r * w, r.Inverse(), r.Inverse(v), r.Inverse(t), f * g, f * v, f * t, f * w,
        f.Inverse(), f.Inverse(v), f.Inverse(t), f.Inverse(w), r.GetRPY(), r.GetEulerZYX(), r.GetEulerZYZ(),
        r.GetQuaternion(), s.GetQuaternion(), s.GetRotAngle(), s.GetRot(), r.UnitX(), r.UnitY(), r.UnitZ(),
        t.RefPoint(v), w.RefPoint(v), t + t, t - t * 2.0, -t, 2.0 * w, w / 3.0, v * u, v * 2, 3 * v, v / 2, v + u,
        PyKDL.diff(f, g), PyKDL.diff(f, g, 0.5), PyKDL.diff(r, s), PyKDL.diff(v, u), PyKDL.diff(t, t * 3.0, 2.0),
        PyKDL.addDelta(f, t), PyKDL.addDelta(r, v, 0.1), PyKDL.addDelta(v, u, 0.3), PyKDL.dot(t, w), PyKDL.dot(w, t),
        PyKDL.dot(v, u), v.Norm(), Frame.DH(0.1, 0.2, 0.3, 0.4), Frame.DH_Craig1989(0.1, 0.2, 0.3, 0.4),
        Rotation.EulerZYX(*v), Rotation.EulerZYZ(*v), Rotation(v, u, v * u), Rotation.Quaternion(*s.GetQuaternion()),
        Rotation.RotX(v[0]), Rotation.RotY(v[0]), Rotation.RotZ(v[0]), Rotation.Rot2(Vector(0, 0, 1), v[1]),
    ):  # fmt: skip
        print(show(value))
    f.Integrate(t, 10.0)
    r.DoRotX(0.1)
    r.DoRotY(0.2)
    r.DoRotZ(0.3)
    s.SetInverse()
    print(show(f), show(r), show(s))
for special in (math.pi, 0.0, 1e-9, -math.pi / 2):
    for r in (Rotation.RotX(special), Rotation.RotY(special), Rotation.Rot(Vector(1, 1, 0), special)):
        print(show(tuple(abs(x) for x in r.GetRPY())), show(r.GetRotAngle()), show(r.GetQuaternion()))
print(Vector(1, 2.5, -3), repr(Rotation()), Frame(Vector(1, 2, 3)), Twist(), Wrench(Vector(1, 2, 3), Vector(4, 5, 6)))
print(
    Vector(1, 2, 3) == Vector(1, 2, 3 + 1e-9), Vector() != Vector(1, 0, 0), Frame() == Frame(Rotation()), Vector() == 3
)
print(PyKDL.Equal(Vector(1, 2, 3), Vector(1, 2, 3.01)), PyKDL.Equal(Frame(), Frame(), 1.0))
v = Vector(3, 0, 4)
print(v.Normalize(), v, list(v), Vector.Zero(), copy.copy(v), copy.deepcopy(Frame(v)).p)
v[1] = 7
v += Vector(1, 1, 1)
v.ReverseSign()
print(v, v.x(), v.y(), v.z())
t = Twist(Vector(1, 2, 3), Vector(4, 5, 6))
t.vel[0] = 9
t.rot = Vector(0, 0, 1)
f = Frame()
f.p[2] = 4
f.M = Rotation.RotZ(math.pi)
f.p = f.p + Vector(1, 0, 0)
print(t, show(f), t.vel + t.rot, pickle.loads(pickle.dumps(Vector(1, 2, 3))))
PyKDL.SetToZero(t)
print(t)
for bad in (
    lambda: Vector(1, 2),
    lambda: Vector()[3],
    lambda: Frame()[3, 0],
    lambda: Rotation(1, 2),
    lambda: Vector() + 1,
):
    try:
        bad()
    except (TypeError, IndexError) as error:
        print(type(error).__name__)
print(Vector, Frame, Rotation.__module__, Twist.__module__, Wrench.__module__)
