"""<inertial auto="true"> of SDF 1.11: mass properties from collision volumes and densities."""

import math
from collections.abc import Iterable, Sequence

from trundle.base.xmlnode import XmlNode
from trundle.robots.model import Box, Capsule, Collision, Cone, Cylinder, Ellipsoid, Geometry, Inertial, Link, Sphere
from trundle.spatial import Pose, Vector3

from ..inertia_sum import rotate_inertia, sum_inertias
from .context import Context

_WATER = 1000.0
"""[kg/m³] SDF's default density."""


def inertial_of_collisions(link: Link, node: XmlNode, context: Context) -> Inertial:
    """Sum the inertias of a link's collisions, scaled to an explicit mass.

    Shapes without a closed formula count as massless, with a warning.
    """
    report = context.report
    inertial = node.find("inertial")
    assert inertial is not None
    overall = inertial.number("density", default=_WATER)
    bodies: list[tuple[float, Pose, Vector3]] = []
    for collision, child in zip(link.collisions, node.all("collision"), strict=True):
        properties = volume_and_moments(collision.geometry)
        if properties is None:
            report.warn(
                collision.at,
                f"collision {collision.name!r}: no automatic inertia for its shape; it weighs 0",
                "auto-inertia",
            )
            continue
        volume, per_mass = properties
        mass = volume * child.number("density", default=overall)
        bodies.append((mass, _pose(collision), (per_mass[0] * mass, per_mass[1] * mass, per_mass[2] * mass)))
    total = sum(mass for mass, _, _ in bodies)
    if not total > 0.0:
        report.warn(
            node.at,
            f"link {link.name!r}: no collision for an automatic inertia; 1 kg and 1 kg·m² are used",
            "auto-inertia",
        )
        return Inertial()
    return _combined(bodies, link.inertial.mass if inertial.find("mass") is not None else total)


def _combined(bodies: Sequence[tuple[float, Pose, Vector3]], mass: float) -> Inertial:
    """Return the inertial of bodies (mass, pose, moments), scaled to a mass [kg]."""
    tensors = [
        (body_mass, pose.position, rotate_inertia((*moments, 0.0, 0.0, 0.0), pose.quaternion))
        for body_mass, pose, moments in bodies
    ]
    total, centre, tensor = sum_inertias(tensors)
    ixx, iyy, izz, ixy, ixz, iyz = (value * mass / total for value in tensor)
    return Inertial(mass=mass, link_from_com=Pose(centre), moments=(ixx, iyy, izz), products=(ixy, ixz, iyz))


def enclosed_volume(collisions: Iterable[Collision]) -> float | None:
    """Return the volume of a link's collisions [m³]; None if a shape has no closed formula."""
    properties = [volume_and_moments(collision.geometry) for collision in collisions]
    return None if None in properties else sum(known[0] for known in properties if known is not None)


def uniform_inertial(collisions: Sequence[Collision], mass: float) -> Inertial | None:
    """Return the inertial of a link with collisions of uniform density; None if their volume is 0 or unknown."""
    if not enclosed_volume(collisions):
        return None
    bodies: list[tuple[float, Pose, Vector3]] = []
    for collision in collisions:
        volume, (x, y, z) = volume_and_moments(collision.geometry) or (0.0, (0.0, 0.0, 0.0))
        bodies.append((volume, _pose(collision), (x * volume, y * volume, z * volume)))
    return _combined(bodies, mass)


def _pose(collision: Collision) -> Pose:
    if isinstance(collision.geometry, Cone):  # centre of mass of a cone: a quarter of the height above its base
        return collision.link_from_collision @ Pose((0.0, 0.0, -collision.geometry.length / 4))
    return collision.link_from_collision


def volume_and_moments(geometry: Geometry) -> tuple[float, Vector3] | None:
    """Return volume [m³] and principal moments per unit mass [m²] about the centre of mass."""
    match geometry:
        case Box((x, y, z)):
            return x * y * z, ((y * y + z * z) / 12, (x * x + z * z) / 12, (x * x + y * y) / 12)
        case Cylinder(r, h):
            across = (3 * r * r + h * h) / 12
            return math.pi * r * r * h, (across, across, r * r / 2)
        case Sphere(r):
            return 4 / 3 * math.pi * r**3, (0.4 * r * r, 0.4 * r * r, 0.4 * r * r)
        case Ellipsoid((a, b, c)):
            return 4 / 3 * math.pi * a * b * c, ((b * b + c * c) / 5, (a * a + c * c) / 5, (a * a + b * b) / 5)
        case Cone(r, h):
            across = 3 / 20 * r * r + 3 / 80 * h * h
            return math.pi * r * r * h / 3, (across, across, 0.3 * r * r)
        case Capsule(r, h):
            return _capsule(r, h)
        case _:
            return None


def _capsule(r: float, h: float) -> tuple[float, Vector3]:
    """Sum a cylinder and two hemispheres, whose centres of mass are 3/8 r from their flat sides."""
    cylinder, ball = math.pi * r * r * h, 4 / 3 * math.pi * r**3
    volume = cylinder + ball
    along = (cylinder * r * r / 2 + ball * 0.4 * r * r) / volume
    across = cylinder * (3 * r * r + h * h) / 12 + ball * (0.4 * r * r + h * h / 4 + 3 / 8 * h * r)
    return volume, (across / volume, across / volume, along)
