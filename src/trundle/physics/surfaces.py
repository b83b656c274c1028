"""What two surfaces are like where they touch, by ODE's rules as Gazebo uses them."""

import math

from msgspec import Struct

from trundle.model import Surface
from trundle.spatial import ZERO, Vector3

INFINITE_FRICTION = 100.0
"""What SDF's negative mu stands for: steeper than any slope."""
_LEAST = 1e-4
"""Least ratio of one friction to the other: none at all is more than MuJoCo's solver takes."""


class Touch(Struct, frozen=True, kw_only=True):
    """Two surfaces as one."""

    mu: float
    mu2: float
    fdir1: Vector3
    """First friction direction; zero: left to the engine."""
    fdir1_of: int
    """In the frame of which of the two."""
    torsion: float
    """[m] Largest torque about the normal over the normal force."""
    kp: float
    """[N/m]"""
    kd: float
    """[N·s/m]"""
    min_depth: float
    """[m] Up to which they stop each other, and do not push each other out."""
    restitution: float
    threshold: float
    """[m/s]"""
    is_felt: bool
    """Whether the two push each other, not only meet."""
    points: int = 1
    """How many of ODE's contact points one contact stands for."""


def touch_of(a: Surface, b: Surface, *, points: int = 1) -> Touch:
    """The smaller friction wins, springs act in series, dampers add up, both must bounce; the first's min_depth counts.

    Args:
        a: of the first; where one of the two stands, that is the other.
        b: of the second.
        points: see `Touch`.
    """
    mu, mu2 = min(_friction(a.mu), _friction(b.mu)), min(_friction(a.mu2), _friction(b.mu2))
    return Touch(
        mu=max(mu, _LEAST * mu2),
        mu2=max(mu2, _LEAST * mu),
        fdir1=a.fdir1 if a.fdir1 != ZERO else b.fdir1,
        fdir1_of=0 if a.fdir1 != ZERO else 1,
        torsion=_torsion(a, b),
        kp=1 / (1 / max(a.kp, 1e-3) + 1 / max(b.kp, 1e-3)),
        kd=max(a.kd, 0.0) + max(b.kd, 0.0),
        min_depth=max(a.min_depth, 0.0),
        restitution=min(max(min(a.restitution, b.restitution), 0.0), 1.0),
        threshold=min(a.bounce_threshold, b.bounce_threshold),
        is_felt=not (a.collide_without_contact or b.collide_without_contact),
        points=points,
    )


def may_meet(a: Surface, b: Surface) -> bool:
    """Whether their collide_bitmasks share a bit; as in Gazebo 11, the category_bitmasks do not count."""
    return bool(a.collide_bitmask & b.collide_bitmask)


def is_plain(surface: Surface) -> bool:
    """Whether a shape can carry by itself all that its contacts need, as long as they are hard: friction, bitmasks."""
    default = Surface()
    return (surface.fdir1, surface.patch_radius, surface.restitution, surface.collide_without_contact) == (
        default.fdir1,
        default.patch_radius,
        default.restitution,
        default.collide_without_contact,
    )


def _friction(mu: float) -> float:
    return INFINITE_FRICTION if mu < 0 else min(mu, INFINITE_FRICTION)


def _torsion(a: Surface, b: Surface) -> float:
    """3π/16 · patch radius · coefficient: Hertz' pressure over a round patch."""
    coefficient = min(_friction(a.torsional_coefficient), _friction(b.torsional_coefficient))
    return 3 * math.pi / 16 * coefficient * max(a.patch_radius, b.patch_radius, 0.0)


def friction_of(surface: Surface) -> float:
    """A surface's own friction."""
    return _friction(surface.mu)
