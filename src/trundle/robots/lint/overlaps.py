"""Check for overlapping static models, of which one is likely misplaced."""

from collections.abc import Iterator
from itertools import combinations

from trundle.base.diagnostics import Diagnostics
from trundle.robots.model import Box, Capsule, Collision, Cylinder, Ellipsoid, Model, Sphere
from trundle.spatial import Pose, Vector3

_MAX_BODIES = 1000
"""Maximum number of static models that are compared; in a larger world, only the first ones are."""


def report_overlaps(models: tuple[Model, ...], report: Diagnostics) -> None:
    """Report every pair of static models with the centre of one's shape inside the other's.

    Args:
        models: flattened models.
        report: receives a note for each pair.
    """
    static = [(model, list(_solids(model))) for model in models if model.static][:_MAX_BODIES]
    for (first, solids), (second, others) in combinations(static, 2):
        if any(_contains_center(one, other) or _contains_center(other, one) for one in solids for other in others):
            message = f"model {second.name!r} overlaps model {first.name!r}, and both are static; is one misplaced?"
            report.info(second.at, message, "overlapping-models")


def _solids(model: Model) -> Iterator[tuple[Pose, Vector3]]:
    """Yield the world pose of each primitive shape, and half the size of a box inscribed in it."""
    for link in model.links:
        world_from_link = model.world_from_model @ link.model_from_link
        for collision in link.collisions:
            half = _half_lengths(collision)
            if half is not None:
                yield world_from_link @ collision.link_from_collision, half


def _half_lengths(collision: Collision) -> Vector3 | None:
    match collision.geometry:
        case Box((x, y, z)):
            return x / 2, y / 2, z / 2
        case Sphere(radius):
            return radius * 0.57, radius * 0.57, radius * 0.57  # 1 / √3, the cube inscribed in a sphere
        case Ellipsoid((x, y, z)):
            return x * 0.57, y * 0.57, z * 0.57
        case Cylinder(radius, length) | Capsule(radius, length):
            return radius * 0.7, radius * 0.7, length / 2
        case _:
            return None


def _contains_center(solid: tuple[Pose, Vector3], other: tuple[Pose, Vector3]) -> bool:
    (pose, half), (world_from_other, _) = solid, other
    if not _within_distance(pose.position, world_from_other.position, sum(half)):
        return False
    center = pose.inverse().transform_point(world_from_other.position)
    return all(abs(coordinate) < bound for coordinate, bound in zip(center, half, strict=True))


def _within_distance(a: Vector3, b: Vector3, distance: float) -> bool:
    return abs(a[0] - b[0]) < distance and abs(a[1] - b[1]) < distance and abs(a[2] - b[2]) < distance
