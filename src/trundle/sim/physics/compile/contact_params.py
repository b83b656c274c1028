"""Contact parameters of a pair of surfaces, by ODE's rules as Gazebo uses them."""

import math

from msgspec import Struct

from trundle.robots.model import Surface
from trundle.spatial import ZERO, Vector3

INFINITE_FRICTION = 100.0
"""Friction coefficient for SDF's negative mu (infinite)."""
_MIN_RATIO = 1e-4
"""Smallest ratio between the two friction coefficients; MuJoCo's solver does not take zero."""
_MAX_CORRECTING_VEL = 100.0
"""Gazebo's default of a world's contact_max_correcting_vel [m/s]."""
_MAX_SLIP = 1e9
"""Upper bound of slip [m/s/N, rad/s/(N·m)], practically without friction."""
_PAIR_PARAMETERS = (
    "fdir1",
    "slip1",
    "slip2",
    "torsional_slip",
    "patch_radius",
    "surface_radius",
    "restitution",
    "collide_without_contact",
)
"""Parameters that only an explicit pair supports."""


class ContactParams(Struct, frozen=True, kw_only=True):
    """Combined contact parameters of two surfaces."""

    mu: float
    mu2: float
    fdir1: Vector3
    """First friction direction; zero: chosen by the engine."""
    fdir1_shape: int
    """Index (0 or 1) of the shape in whose frame fdir1 is given."""
    slip: Vector3
    """Slip compliance along the first friction direction and across it [m/s/N], and about the normal [rad/s/(N·m)]."""
    torsion: float
    """Torsional friction: largest torque about the normal over the normal force [m]."""
    patch: float
    """Square of the torsional friction per newton of normal force [m²/N], for a patch that grows with the load; 0:
    `torsion` is used.
    """
    kp: float
    """[N/m]"""
    kd: float
    """[N·s/m]"""
    min_depth: float
    """Penetration without correction [m]."""
    max_vel: float
    """Largest speed of depth correction [m/s]."""
    restitution: float
    threshold: float
    """[m/s]"""
    has_force: bool
    """False if the contact is detected without a force."""
    points: float = 1
    """Number of ODE contact points represented by one contact."""


def combine_surfaces(a: Surface, b: Surface, *, b_fixed: bool = False, points: float = 1) -> ContactParams:
    """Combine two surfaces: smaller friction, springs in series, dampers and slips added.

    min_depth and max_vel are the moving surface's; of two moving ones, the smaller.

    As Gazebo's `ODEPhysics::Collide`, which computes the fdir1 of the second surface and never uses it; ODE's second
    geom is the larger, as a rule the fixed one. Slip does not depend on the number of contact points.

    Args:
        a: first surface; the moving one if the other is fixed.
        b: second surface.
        b_fixed: True if the second is fixed.
        points: see `ContactParams`.
    """
    mu, mu2 = _nonzero_pair(min(_friction(a.mu), _friction(b.mu)), min(_friction(a.mu2), _friction(b.mu2)))
    first = 0 if a.fdir1 != ZERO or b_fixed else 1
    kp = 1 / (1 / max(a.kp, 1e-3) + 1 / max(b.kp, 1e-3))
    torsion, patch = _torsion(a, b, kp)
    return ContactParams(
        mu=mu,
        mu2=mu2,
        fdir1=(a, b)[first].fdir1,
        fdir1_shape=first,
        slip=(
            _bounded(a.slip1 + b.slip1),
            _bounded(a.slip2 + b.slip2),
            _bounded(a.torsional_slip + b.torsional_slip),
        ),
        torsion=torsion,
        patch=patch,
        kp=kp,
        kd=max(a.kd, 0.0) + max(b.kd, 0.0),
        min_depth=max(a.min_depth if b_fixed else min(a.min_depth, b.min_depth), 0.0),
        max_vel=_max_vel(a) if b_fixed else min(_max_vel(a), _max_vel(b)),
        restitution=min(max(min(a.restitution, b.restitution), 0.0), 1.0),
        threshold=min(a.bounce_threshold, b.bounce_threshold),
        has_force=not (a.collide_without_contact or b.collide_without_contact),
        points=points,
    )


def bitmasks_match(a: Surface, b: Surface) -> bool:
    """True if the collide_bitmasks share a bit; as in Gazebo 11, category_bitmasks are ignored."""
    return bool(a.collide_bitmask & b.collide_bitmask)


def is_plain(surface: Surface) -> bool:
    """True if a geom's own parameters can express the surface's hard contacts: friction and bitmasks only."""
    default = Surface()
    return all(getattr(surface, name) == getattr(default, name) for name in _PAIR_PARAMETERS)


def _max_vel(surface: Surface) -> float:
    """Return a surface's max_vel, at most Gazebo's contact_max_correcting_vel; a negative one means that bound."""
    return min(surface.max_vel, _MAX_CORRECTING_VEL) if surface.max_vel >= 0.0 else _MAX_CORRECTING_VEL


def _friction(mu: float) -> float:
    return INFINITE_FRICTION if mu < 0 else min(mu, INFINITE_FRICTION)


def _nonzero_pair(mu: float, mu2: float) -> tuple[float, float]:
    """Return two coefficients, neither of them zero unless both are."""
    return max(mu, _MIN_RATIO * mu2), max(mu2, _MIN_RATIO * mu)


def _bounded(slip: float) -> float:
    return max(0.0, min(slip, _MAX_SLIP))


def _torsion(a: Surface, b: Surface, kp: float) -> tuple[float, float]:
    """Return torsion and patch of `ContactParams`: 3π/16 · coefficient · patch radius, for Hertz pressure over a round
    patch.

    The patch radius is <patch_radius>, or √(radius of curvature · depth) with a contact depth of load / kp.
    """
    factor = 3 * math.pi / 16 * min(_friction(a.torsional_coefficient), _friction(b.torsional_coefficient))
    if a.use_patch_radius and b.use_patch_radius:
        return factor * max(a.patch_radius, b.patch_radius, 0.0), 0.0
    curvature = sum(1 / surface.surface_radius for surface in (a, b) if surface.surface_radius > 0)
    return 0.0, factor**2 / (curvature * kp) if curvature > 0 else 0.0


def friction_of(surface: Surface) -> float:
    """Return a surface's friction coefficient along its first friction direction."""
    return _friction(surface.mu)


def frictions_of(surface: Surface) -> tuple[float, float]:
    """Return a surface's friction coefficients along its first friction direction and across it."""
    return _nonzero_pair(_friction(surface.mu), _friction(surface.mu2))
