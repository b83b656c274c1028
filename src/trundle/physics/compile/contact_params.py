"""What two surfaces are like where they touch, by ODE's rules as Gazebo uses them."""

import math

from msgspec import Struct

from trundle.model import Surface
from trundle.spatial import ZERO, Vector3

INFINITE_FRICTION = 100.0
"""What SDF's negative mu stands for: steeper than any slope."""
_LEAST = 1e-4
"""Least ratio of one friction to the other: none at all is more than MuJoCo's solver takes."""
_MAX_SLIP = 1e9
"""[m/s/N, rad/s/(N·m)] As good as none of the friction."""
_OF_PAIRS = (
    "fdir1",
    "slip1",
    "slip2",
    "torsional_slip",
    "patch_radius",
    "surface_radius",
    "restitution",
    "collide_without_contact",
)
"""What only a pair of shapes can have."""


class ContactParams(Struct, frozen=True, kw_only=True):
    """Two surfaces as one."""

    mu: float
    mu2: float
    fdir1: Vector3
    """First friction direction; zero: left to the engine."""
    fdir1_shape: int
    """In the frame of which of the two."""
    slip: Vector3
    """[m/s/N] along the first friction direction and across it, [rad/s/(N·m)] about the normal."""
    torsion: float
    """[m] Largest torque about the normal over the normal force."""
    patch: float
    """[m²/N] The square of the same, for each newton of normal force: what is pressed harder has a larger patch.
    0: `torsion` counts."""
    kp: float
    """[N/m]"""
    kd: float
    """[N·s/m]"""
    min_depth: float
    """[m] Up to which they stop each other, and do not push each other out."""
    restitution: float
    threshold: float
    """[m/s]"""
    has_force: bool
    """Whether the two push each other, not only meet."""
    points: int = 1
    """How many of ODE's contact points one contact stands for."""


def combine_surfaces(a: Surface, b: Surface, *, b_stands: bool = False, points: int = 1) -> ContactParams:
    """The smaller friction wins, springs act in series, dampers and slips add up; the first's min_depth counts.

    As Gazebo's `ODEPhysics::Collide` has it. The fdir1 of the second of two it works out and never uses; ODE's second
    is the larger, which is what stands, as a rule. What slips, slips by as much for any number of contact points.

    Args:
        a: of the first; where one of the two stands, that is the other.
        b: of the second.
        b_stands: whether nothing moves the second.
        points: see `ContactParams`.
    """
    mu, mu2 = min(_friction(a.mu), _friction(b.mu)), min(_friction(a.mu2), _friction(b.mu2))
    first = 0 if a.fdir1 != ZERO or b_stands else 1
    kp = 1 / (1 / max(a.kp, 1e-3) + 1 / max(b.kp, 1e-3))
    torsion, patch = _torsion(a, b, kp)
    return ContactParams(
        mu=max(mu, _LEAST * mu2),
        mu2=max(mu2, _LEAST * mu),
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
        min_depth=max(a.min_depth, 0.0),
        restitution=min(max(min(a.restitution, b.restitution), 0.0), 1.0),
        threshold=min(a.bounce_threshold, b.bounce_threshold),
        has_force=not (a.collide_without_contact or b.collide_without_contact),
        points=points,
    )


def bitmasks_match(a: Surface, b: Surface) -> bool:
    """Whether their collide_bitmasks share a bit; as in Gazebo 11, the category_bitmasks do not count."""
    return bool(a.collide_bitmask & b.collide_bitmask)


def is_plain(surface: Surface) -> bool:
    """Whether a shape can carry by itself all that its contacts need, as long as they are hard: friction, bitmasks."""
    default = Surface()
    return all(getattr(surface, name) == getattr(default, name) for name in _OF_PAIRS)


def _friction(mu: float) -> float:
    return INFINITE_FRICTION if mu < 0 else min(mu, INFINITE_FRICTION)


def _bounded(slip: float) -> float:
    return max(0.0, min(slip, _MAX_SLIP))


def _torsion(a: Surface, b: Surface, kp: float) -> tuple[float, float]:
    """Torsion and patch of `ContactParams`: 3π/16 · coefficient · patch radius, by Hertz' pressure over a round patch.

    The radius is the one that is written, or √(curvature · depth), and load / kp is how deep a contact point is.
    """
    factor = 3 * math.pi / 16 * min(_friction(a.torsional_coefficient), _friction(b.torsional_coefficient))
    if a.use_patch_radius and b.use_patch_radius:
        return factor * max(a.patch_radius, b.patch_radius, 0.0), 0.0
    curvature = sum(1 / each.surface_radius for each in (a, b) if each.surface_radius > 0)
    return 0.0, factor**2 / (curvature * kp) if curvature > 0 else 0.0


def friction_of(surface: Surface) -> float:
    """A surface's own friction."""
    return _friction(surface.mu)
