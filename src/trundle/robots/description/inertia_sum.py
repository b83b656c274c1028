"""Sum of rigid-body inertias, by the parallel axis theorem."""

from collections.abc import Sequence
from typing import TypeAlias

from trundle.spatial import Quaternion, Vector3, rotate

Tensor: TypeAlias = tuple[float, float, float, float, float, float]
"""ixx, iyy, izz, ixy, ixz, iyz [kg·m²]"""
_AXES: tuple[Vector3, ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
_ENTRIES = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


def rotate_inertia(tensor: Tensor, turn: Quaternion) -> Tensor:
    """Return an inertia tensor in rotated axes.

    Args:
        tensor: inertia in the body's axes.
        turn: rotation new_from_body.
    """
    xx, yy, zz, xy, xz, yz = tensor
    rows = ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))
    body_axes = [rotate(turn, axis) for axis in _AXES]

    def entry(i: int, j: int) -> float:
        return sum(body_axes[k][i] * rows[k][m] * body_axes[m][j] for k in range(3) for m in range(3))

    a, b, c, d, e, f = (entry(i, j) for i, j in _ENTRIES)
    return a, b, c, d, e, f


def sum_inertias(bodies: Sequence[tuple[float, Vector3, Tensor]]) -> tuple[float, Vector3, Tensor]:
    """Return mass [kg], centre of mass [m] and inertia about it of several bodies together.

    Args:
        bodies: (mass, centre of mass, inertia about it) per body, in common axes; total mass > 0.
    """
    mass = sum(m for m, _, _ in bodies)
    x, y, z = (sum(m * centre[i] for m, centre, _ in bodies) / mass for i in range(3))
    total = [0.0] * 6
    for m, (px, py, pz), tensor in bodies:
        arm = (px - x, py - y, pz - z)
        square = sum(a * a for a in arm)
        for entry, (i, j) in enumerate(_ENTRIES):
            total[entry] += tensor[entry] + m * ((square if i == j else 0.0) - arm[i] * arm[j])
    a, b, c, d, e, f = total
    return mass, (x, y, z), (a, b, c, d, e, f)
