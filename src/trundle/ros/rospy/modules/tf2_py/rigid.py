"""Rigid transforms as pairs of tuples: translation (x, y, z) [m] and unit quaternion (x, y, z, w).

Tuples, for numpy's calls cost more than these few products do.
"""

import math

IDENTITY = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))


def rotate(q, v):
    """Rotate a vector by a quaternion."""
    qx, qy, qz, qw = q
    x, y, z = v
    tx, ty, tz = 2.0 * (qy * z - qz * y), 2.0 * (qz * x - qx * z), 2.0 * (qx * y - qy * x)
    return (x + qw * tx + qy * tz - qz * ty, y + qw * ty + qz * tx - qx * tz, z + qw * tz + qx * ty - qy * tx)


def multiply(a, b):
    """Hamilton product of two quaternions."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def compose(a_from_b, b_from_c):
    """`a_from_c`."""
    (tx, ty, tz), q = a_from_b
    x, y, z = rotate(q, b_from_c[0])
    return (x + tx, y + ty, z + tz), multiply(q, b_from_c[1])


def invert(a_from_b):
    """`b_from_a`."""
    (x, y, z), (qx, qy, qz, qw) = a_from_b
    back = (0.0 - qx, 0.0 - qy, 0.0 - qz, qw)  # no -0.0, which would be printed
    return rotate(back, (0.0 - x, 0.0 - y, 0.0 - z)), back


def with_matrix_sign(q):
    """The one of q and -q that comes of a rotation matrix: w > 0 if the trace is positive, else the largest axis is."""
    decisive = q[3] if abs(q[3]) > 0.5 else max(q[:3], key=abs)
    return tuple(-x for x in q) if decisive < 0.0 else q


def interpolate(first, second, share):
    """Linear in translation, spherical in rotation; share 0 is the first, 1 the second."""
    (a, p), (b, q) = first, second
    position = tuple(x + (y - x) * share for x, y in zip(a, b, strict=True))
    cos = sum(x * y for x, y in zip(p, q, strict=True))
    if cos < 0.0:
        cos, q = -cos, tuple(-x for x in q)
    if cos > 1.0 - 1e-12:
        return position, p
    angle = math.acos(cos)
    u, v = math.sin((1.0 - share) * angle), math.sin(share * angle)
    sin = math.sin(angle)
    return position, tuple((u * x + v * y) / sin for x, y in zip(p, q, strict=True))
