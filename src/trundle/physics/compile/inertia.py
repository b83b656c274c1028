"""Mass properties that MuJoCo accepts; changes are reported."""

import numpy as np
from numpy.typing import NDArray

from trundle.diagnostics import Diagnostics
from trundle.model import Inertial, Link
from trundle.spatial import Pose, quaternion_from_matrix

SMALLEST_MASS = 1e-6
"""Mass in place of zero or less [kg]."""
SMALLEST_MOMENT = 1e-9
"""Smallest principal moment [kg·m²]."""


def principal_inertia(link: Link, report: Diagnostics) -> tuple[float, Pose, tuple[float, float, float]]:
    """Return mass [kg], link_from_principal_axes and the three principal moments [kg·m²].

    Moments that violate the triangle inequality are corrected: the two smaller are raised by the least equal amount.
    """
    inertial = link.inertial
    mass = inertial.mass
    if not mass >= SMALLEST_MASS:
        report.warn(link.at, f"link {link.name!r}: mass {mass:g} kg cannot move; physics uses {SMALLEST_MASS:g}")
        mass = SMALLEST_MASS
    moments, axes = np.linalg.eigh(_tensor(inertial))
    if np.linalg.det(axes) < 0:
        axes[:, 0] = -axes[:, 0]
    if moments[0] < SMALLEST_MOMENT:
        report.warn(
            link.at,
            f"link {link.name!r}: moment of inertia {moments[0]:g} kg·m² cannot turn; physics uses {SMALLEST_MOMENT:g}",
        )
        moments = np.maximum(moments, SMALLEST_MOMENT)
    excess = moments[2] - (moments[0] + moments[1])
    if excess > 1e-12 * moments[2]:
        report.warn(
            link.at,
            f"link {link.name!r}: principal moments {moments[0]:g}, {moments[1]:g}, {moments[2]:g} kg·m² violate the "
            f"triangle inequality; physics raises the two smaller by {excess / 2:g}",
        )
        moments = moments + np.array([excess / 2, excess / 2, 0.0]) * (1 + 1e-9)
    pose = inertial.link_from_com
    rotated = pose @ Pose(quaternion=quaternion_from_matrix(axes))
    return mass, rotated, (float(moments[0]), float(moments[1]), float(moments[2]))


def _tensor(inertial: Inertial) -> NDArray[np.float64]:
    ixx, iyy, izz = inertial.moments
    ixy, ixz, iyz = inertial.products
    return np.array([[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]])
