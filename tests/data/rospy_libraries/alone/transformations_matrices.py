"""tf.transformations: rotations, reflections, scalings, projections, shears, and back."""

import math
import random

import numpy as np

from tf import transformations as t

rand = random.Random(3)


def r(values):
    """Rounded."""
    return [round(float(v), 5) + 0.0 for v in np.ravel(values)]


def v(count=3):
    """Any vector."""
    return [rand.gauss(0, 1) for _ in range(count)]


def again(make, matrix, arguments):
    """True if the arguments found make the same matrix."""
    return t.is_same_transform(matrix, make(*arguments))


for _ in range(4):
    angle, direction, point, normal, eye = rand.uniform(-3, 3), v(), v(), v(), v()
    m = t.rotation_matrix(angle, direction, point)
    print(r(m), r(t.rotation_matrix(angle, direction)), again(t.rotation_matrix, m, t.rotation_from_matrix(m)))
    m = t.reflection_matrix(point, normal)
    print(r(m), again(t.reflection_matrix, m, t.reflection_from_matrix(m)))
    for arguments in ((2.5,), (-1.3, point), (0.4, point, direction)):
        m = t.scale_matrix(*arguments)
        found = t.scale_from_matrix(m)
        print(r(m), round(float(found[0]), 6), again(t.scale_matrix, m, found))
    for kind in ({}, {"direction": direction}, {"perspective": eye}, {"perspective": eye, "pseudo": True}):
        m = t.projection_matrix(point, normal, **kind)
        print(r(m), again(t.projection_matrix, m, t.projection_from_matrix(m, pseudo=bool(kind.get("pseudo")))))
    m = t.shear_matrix(abs(angle) % 1.2, np.cross(direction, normal), point, normal)
    print(r(m), round(float(t.shear_from_matrix(m)[0]), 1))
    print(r(t.translation_from_matrix(t.translation_matrix(point))), r(t.inverse_matrix(t.translation_matrix(point))))
for bad in (
    lambda: t.rotation_from_matrix(np.diag([2, 3, 4, 1])),
    lambda: t.reflection_from_matrix(np.identity(4)),
    lambda: t.shear_matrix(1, [1, 0, 0], [0, 0, 0], [1, 1, 0]),
    lambda: t.scale_from_matrix(t.translation_matrix([1, 2, 3]) * 2),
    lambda: t.clip_matrix(1, 0, 0, 1, 0, 1),
    lambda: t.clip_matrix(0, 1, 0, 1, 0, 1, True),
    lambda: t.decompose_matrix(np.zeros((4, 4))),
    lambda: t.superimposition_matrix(np.ones((3, 2)), np.ones((3, 2))),
):
    try:
        bad()
        print("no error")
    except ValueError as error:
        print(type(error).__name__)
print(r(t.rotation_matrix(math.pi / 2, [0, 0, 1], [1, 0, 0]) @ [0, 0, 0, 1]), r(t.identity_matrix()))
