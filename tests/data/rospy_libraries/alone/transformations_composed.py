"""tf.transformations: composition and decomposition, frustums, crystal cells, point sets, arcball."""

import random

import numpy as np

from tf import transformations as t

rand = random.Random(5)


def r(values):
    """Rounded."""
    return [round(float(v), 5) + 0.0 for v in np.ravel(values)]


def v(count=3):
    """Any vector."""
    return [rand.gauss(0, 1) for _ in range(count)]


for _ in range(4):
    m = t.compose_matrix(v(), v(), v(), v(), [abs(x) * 0.1 + 0.5 for x in v(4)])
    scale, shear, angles, translate, perspective = t.decompose_matrix(m)
    print(r(m), r(scale), r(shear), r(angles), r(translate), r(perspective))
    print(t.is_same_transform(m, t.compose_matrix(scale, shear, angles, translate, perspective)))
    points = np.array([v(8) for _ in range(3)])
    moved = t.rotation_matrix(1.1, v())[:3, :3] @ points * 1.5 + 0.3 + 0.01 * np.array([v(8) for _ in range(3)])
    for scaling in (False, True):
        for usesvd in (True, False):
            print(r(t.superimposition_matrix(points, moved, scaling, usesvd)))
print(r(t.compose_matrix()), r(t.compose_matrix(angles=[0.1, 0.2, 0.3], translate=[1, 2, 3])))
print(r(t.concatenate_matrices()), r(t.concatenate_matrices(t.translation_matrix([1, 2, 3]), t.scale_matrix(2))))
print(t.is_same_transform(np.identity(4), np.identity(4) * 3), t.is_same_transform(np.identity(4), t.scale_matrix(2)))
print(r(t.clip_matrix(-1, 2, -3, 1, 0.5, 4)), r(t.clip_matrix(-1, 2, -3, 1, 0.5, 4, True)))
print(
    r(t.orthogonalization_matrix((10.0, 10.0, 10.0), (90.0, 90.0, 90.0))),
    r(t.orthogonalization_matrix([9.8, 12.0, 15.5], [87.2, 80.7, 69.7])),
)
for constrained in (False, True):
    ball = t.Arcball(t.quaternion_about_axis(0.3, [1, 2, 3]))
    ball.place([320, 320], 320)
    ball.setaxes([1, 1, 0], [-1, 1, 0])
    ball.setconstrain(constrained)
    ball.down([500, 250])
    ball.drag([475, 275])
    print(ball.getconstrain(), r(ball.matrix()))
    ball.next()
    ball.next(0.5)
    print(r(ball.matrix()))
print(r(t.arcball_map_to_sphere([400, 100], [320, 320], 320)), r(t.arcball_map_to_sphere([900, 100], [320, 320], 320)))
for axis in ([1, 0, 0], [0, 0, 1], [0.6, 0.8, 0]):
    print(r(t.arcball_constrain_to_axis([0.1, -0.2, 0.97], axis)), r(t.arcball_constrain_to_axis(axis, axis)))
print(r(t.arcball_nearest_axis([0.5, 0.5, 0.7], [[1, 0, 0], [0, 1, 0], [0, 0, 1]])))
for wrong in (np.zeros((3, 3)), [1, 2, 3]):
    try:
        t.Arcball(wrong)
    except ValueError as error:
        print(type(error).__name__)
