"""Mass properties as MuJoCo's compiler accepts them; changes are reported."""

import mujoco
import numpy as np
from numpy.typing import NDArray

from trundle.base.diagnostics import Diagnostics
from trundle.robots.model import Inertial, Link
from trundle.spatial import Pose, quaternion_from_matrix

SMALLEST_MASS = 1e-6
"""Mass in place of zero or less [kg]."""
SMALLEST_MOMENT = 1e-9
"""Smallest principal moment [kg·m²]."""
_ROUNDING = 1e-12
_MARGIN = 1e-15
"""Margin by which the sum of two moments exceeds the third, relative to it, so that rounding does not undo it."""
_MAX_RATIO = 10.0
"""Largest difference of two moments, divided by the third; 1 in rigid bodies; the gyroscopic torque grows with it."""


def principal_inertia(link: Link, report: Diagnostics) -> tuple[float, Pose, tuple[float, float, float]]:
    """Return mass [kg], link_from_principal_axes and the three principal moments [kg·m²].

    Moments that violate the triangle inequality are used as written, as in Gazebo: published robots have some. If the
    violation is large, the two smaller are raised equally, as little as possible.
    """
    inertial = link.inertial
    mass = inertial.mass
    if not mass >= SMALLEST_MASS:
        report.warn(
            link.at,
            f"link {link.name!r}: mass {mass:g} kg cannot move; physics uses {SMALLEST_MASS:g}",
            "impossible-inertia",
        )
        mass = SMALLEST_MASS
    moments, axes = np.linalg.eigh(_tensor(inertial))
    if np.linalg.det(axes) < 0:
        axes[:, 0] = -axes[:, 0]
    if moments[0] < SMALLEST_MOMENT:
        report.warn(
            link.at,
            f"link {link.name!r}: moment of inertia {moments[0]:g} kg·m² cannot turn; physics uses {SMALLEST_MOMENT:g}",
            "impossible-inertia",
        )
        moments = np.maximum(moments, SMALLEST_MOMENT)
    excess = moments[2] - (moments[0] + moments[1])
    if excess > _ROUNDING * moments[2]:
        rise = max(0.0, (moments[2] - moments[1] - _MAX_RATIO * moments[0]) / (1.0 + _MAX_RATIO))
        remedy = f"raises the two smaller by {rise:g}" if rise > 0.0 else "uses them as written"
        report.warn(
            link.at,
            f"link {link.name!r}: principal moments {moments[0]:g}, {moments[1]:g}, {moments[2]:g} kg·m² violate the "
            f"triangle inequality: no body has them; physics {remedy}",
            "impossible-inertia",
        )
        moments = moments + np.array([rise, rise, 0.0])
    pose = inertial.link_from_com
    rotated = pose @ Pose(quaternion=quaternion_from_matrix(axes))
    return mass, rotated, (float(moments[0]), float(moments[1]), float(moments[2]))


def possible_moments(moments: tuple[float, float, float]) -> tuple[float, float, float]:
    """Return moments, ascending, that MuJoCo's compiler accepts: the two smaller are raised if necessary."""
    one, two, three = moments
    excess = three - (one + two)
    rise = excess / 2 * (1 + 1e-9) + _MARGIN * three if excess > 0.0 else 0.0
    return one + rise, two + rise, three


def set_constants(model: mujoco.MjModel) -> None:
    """Compute the constants that depend on a model's masses and moments, as MuJoCo's compiler does."""
    mujoco.mj_setConst(model, mujoco.MjData(model))
    if model.nv:  # the means scale the solver's tolerance; the sums are in MuJoCo's order
        model.stat.meaninertia = sum(model.dof_M0.tolist()) / model.nv
    if model.nbody > 1:
        model.stat.meanmass = sum(model.body_mass[1:].tolist()) / (model.nbody - 1)


def _tensor(inertial: Inertial) -> NDArray[np.float64]:
    ixx, iyy, izz = inertial.moments
    ixy, ixz, iyz = inertial.products
    return np.array([[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]])
