"""tf.transformations: quaternions and vectors."""

import math
import random

import numpy as np

from tf import transformations as t

rand = random.Random(2)


def r(values):
    """Rounded."""
    return [round(float(v), 6) + 0.0 for v in np.ravel(values)]


def q():
    """Any quaternion."""
    return [rand.gauss(0, 1) for _ in range(4)]


for _ in range(6):
    a, b = q(), q()
    print(r(t.quaternion_multiply(a, b)), r(t.quaternion_inverse(a)), r(t.quaternion_conjugate(a)))
    print(r(t.quaternion_matrix(a)), r(t.quaternion_from_matrix(t.quaternion_matrix(a))))
    for fraction in (0, 0.25, 0.7, 1.0):
        print(
            r(t.quaternion_slerp(a, b, fraction)),
            r(t.quaternion_slerp(a, b, fraction, 1)),
            r(t.quaternion_slerp(a, b, fraction, 0, False)),
        )
    print(r(t.quaternion_about_axis(rand.uniform(-4, 4), q()[:3])))
    print(r(t.random_quaternion([0.1, 0.2, abs(a[0]) % 1])), r(t.random_rotation_matrix([abs(a[1]) % 1, 0.5, 0.2])))
for turn in (math.pi, math.pi - 1e-9):
    for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1)):
        print(r(t.quaternion_from_matrix(t.rotation_matrix(turn, axis))))
print(r(t.quaternion_slerp([0, 0, 0, 1], [0, 0, 0, 1], 0.3)), r(t.quaternion_matrix([0, 0, 0, 0])))
print(abs(np.dot(t.random_quaternion(), np.ones(4))) <= 2.0, t.random_rotation_matrix().shape, t.random_vector(5).shape)
v = np.arange(12.0).reshape(3, 4) + 1
for axis in (None, 0, 1, -1):
    print(r(t.vector_norm(v, axis)), r(t.unit_vector(v, axis)))
out = np.empty(3)
print(
    t.vector_norm(v, 1, out),
    r(out),
    t.vector_norm([3, 4]),
    type(t.vector_norm([3, 4])).__name__ in ("float", "float64"),
)
print(r(t.unit_vector([3, 4, 0])), t.vector_norm([]), list(t.unit_vector([])))
