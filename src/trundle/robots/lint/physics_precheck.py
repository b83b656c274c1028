"""Check without an engine that physics accepts a world as written.

Physics replaces invalid values with a warning, but only after loading and compiling. It reports nothing about most
robots: trees of hinges with boxes, cylinders and spheres.
"""

import math
from collections.abc import Iterable

from trundle.robots.model import (
    Box,
    Capsule,
    Collision,
    Cylinder,
    Ellipsoid,
    Geometry,
    Inertial,
    Joint,
    JointAxis,
    JointType,
    Link,
    Model,
    Plane,
    Sphere,
    World,
)
from trundle.spatial import ZERO

_TYPES = frozenset({JointType.REVOLUTE, JointType.PRISMATIC, JointType.FIXED})
_MIN_VALUE = 1e-3
"""Minimum length [m] and mass [kg], at least ten times the smallest that physics keeps."""
_MIN_MOMENT = 1e-8
"""Minimum moment of inertia [kg·m²], ten times the smallest that physics keeps."""
_MAX_VALUE = 1e6


def physics_accepts(world: World) -> bool:
    """True if physics certainly reports nothing about a world.

    Args:
        world: flattened world.
    """
    if world.joints or not 1e-6 < world.physics.max_step_size_s < 0.1 or not _are_different(world.models):
        return False
    return all(map(_is_finite, world.physics.gravity)) and all(map(_is_plain_model, world.models))


def _is_plain_model(model: Model) -> bool:
    if not (model.links and _are_different(model.links) and _are_different(model.joints)):
        return False
    if model.static:
        return not model.joints and all(_has_plain_shapes(link, can_move=False) for link in model.links)
    return (
        _is_tree(model)
        and all(_is_plain_link(link) for link in model.links)
        and all(_is_plain_joint(joint) for joint in model.joints)
    )


def _are_different(named: Iterable[Model] | Iterable[Link] | Iterable[Joint]) -> bool:
    names = [part.name for part in named]
    return len(set(names)) == len(names)


def _is_tree(model: Model) -> bool:
    """True if every joint connects two links, and the links form trees."""
    links = {link.name for link in model.links}
    parents = {joint.child: joint.parent for joint in model.joints}
    if len(parents) != len(model.joints) or not links.issuperset(parents) or not links.issuperset(parents.values()):
        return False
    for link in links:
        above = link
        for _ in range(len(links)):
            above = parents.get(above, "")
        if above:
            return False
    return True


def _is_plain_link(link: Link) -> bool:
    movable = not (link.fixed or link.kinematic)
    return movable and _is_plain_inertial(link.inertial) and _has_plain_shapes(link, can_move=True)


def _is_plain_inertial(inertial: Inertial) -> bool:
    numbers = (inertial.mass, *inertial.moments, *inertial.products, *inertial.link_from_com.position)
    if not all(map(_is_finite, numbers)) or inertial.mass < _MIN_VALUE:
        return False
    smallest, middle, largest = sorted(_eigenvalues(inertial))
    return smallest > _MIN_MOMENT and largest < (smallest + middle) * (1 - 1e-6)


def _eigenvalues(inertial: Inertial) -> tuple[float, float, float]:
    """Return the eigenvalues of the inertia tensor, by the trigonometric solution for symmetric 3 × 3 matrices."""
    scale = max(map(abs, (*inertial.moments, *inertial.products)))
    if scale == 0.0:
        return 0.0, 0.0, 0.0
    xx, yy, zz, xy, xz, yz = (number / scale for number in (*inertial.moments, *inertial.products))
    mean = (xx + yy + zz) / 3
    a, b, c = xx - mean, yy - mean, zz - mean
    spread = math.sqrt((a * a + b * b + c * c + 2 * (xy * xy + xz * xz + yz * yz)) / 6)
    if spread < 1e-15:
        return mean * scale, mean * scale, mean * scale
    determinant = a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz)
    angle = math.acos(max(-1.0, min(1.0, determinant / spread**3 / 2))) / 3
    one, two, three = (scale * (mean + 2 * spread * math.cos(angle + turn * math.tau / 3)) for turn in range(3))
    return one, two, three


def _is_plain_joint(joint: Joint) -> bool:
    if joint.type is JointType.FIXED:
        return True
    axis = joint.axis
    if joint.type not in _TYPES or axis is None or joint.axis2 is not None:
        return False
    has_hard_stops = axis.stop_stiffness >= 1e8  # physics reports a softer limit
    return (
        axis.lower < axis.upper
        and axis.effort > 0.0
        and axis.mimic is None
        and has_hard_stops
        and _adds_no_energy(axis)
    )


def _adds_no_energy(axis: JointAxis) -> bool:
    resisting = (axis.damping, axis.friction, axis.spring_stiffness)
    return all(0.0 <= number < math.inf for number in resisting) and math.isfinite(axis.spring_reference)


def _has_plain_shapes(link: Link, *, can_move: bool) -> bool:
    return all(_is_plain_collision(collision, can_move=can_move) for collision in link.collisions)


def _is_plain_collision(collision: Collision, *, can_move: bool) -> bool:
    surface = collision.surface
    numbers = (surface.mu, surface.mu2, surface.kp, surface.kd, surface.restitution, surface.patch_radius)
    has_idle_direction = not can_move and surface.fdir1 != ZERO
    if has_idle_direction or not all(map(math.isfinite, numbers)):
        return False
    lengths = _lengths(collision.geometry)
    if lengths is None:
        return isinstance(collision.geometry, Plane) and not can_move
    return all(_MIN_VALUE <= length <= _MAX_VALUE for length in lengths)


def _lengths(geometry: Geometry) -> tuple[float, ...] | None:
    match geometry:
        case Box(size):
            return size
        case Sphere(radius):
            return (radius,)
        case Cylinder(radius, length) | Capsule(radius, length):
            return radius, length
        case Ellipsoid(radii):
            return radii
        case _:
            return None


def _is_finite(number: float) -> bool:
    return -_MAX_VALUE <= number <= _MAX_VALUE
