"""tf.transformations: Euler angles in all 24 conventions, there and back."""

import math

from tf import transformations as t


def r(values):
    """Rounded."""
    return [round(float(v), 6) + 0.0 for v in values]


ANGLES = [(0.3, -0.4, 1.2), (-2.5, 0.9, 3.0), (1.0, 0.0, -1.0)]
for axes in sorted(t._AXES2TUPLE):
    for angles in ANGLES:
        matrix = t.euler_matrix(*angles, axes)
        quaternion = t.quaternion_from_euler(*angles, axes)
        print(axes, r(matrix.ravel()[:11]), r(quaternion), r(t.euler_from_matrix(matrix, axes)))
        print(
            r(t.euler_from_quaternion(quaternion, axes)), t.is_same_transform(t.quaternion_matrix(quaternion), matrix)
        )
    print(r(t.euler_matrix(0.1, 0.2, 0.3, t._AXES2TUPLE[axes]).ravel()[:3]))
for angles in ((0.3, math.pi / 2, 0.4), (0.3, -math.pi / 2, 0.4)):
    matrix = t.euler_matrix(*angles)
    print(r(matrix.ravel()), r(t.euler_matrix(*t.euler_from_matrix(matrix)).ravel()))
print(type(t.euler_from_quaternion([0, 0, 0, 1])).__name__, type(t.quaternion_from_euler(0, 0, 0)).__name__)
print(r(t.quaternion_from_euler(0, 0, math.pi / 2)), r(t.euler_from_quaternion((0, 0, 0.7071068, 0.7071068))))
for bad in ("xyz", "sxyq", (9, 9, 9, 9)):
    try:
        t.euler_matrix(1, 2, 3, bad)
    except (KeyError, AttributeError) as error:
        print(type(error).__name__)
