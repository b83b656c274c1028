"""Scaling of a model's shapes by a saved <scale>."""

import math

from msgspec.structs import replace

from trundle.base.diagnostics import Diagnostics, Source
from trundle.robots.model import (
    Box,
    Capsule,
    Cone,
    Cylinder,
    Ellipsoid,
    Empty,
    Geometry,
    Heightmap,
    Link,
    MeshFile,
    Model,
    Plane,
    Polyline,
    Sphere,
)
from trundle.spatial import Vector3


def scaled_model(model: Model, scale: Vector3, at: Source, report: Diagnostics) -> Model:
    """Return the model with the visuals and collisions of its own links scaled, each about its centre, as in Gazebo."""
    if not all(math.isfinite(s) and s > 0.0 for s in scale):
        report.warn(at, f"<scale> of model {model.name!r} needs three numbers > 0; the scale is 1", "invalid-value")
        return model
    report.info(
        at, f"<scale> of model {model.name!r}: its shapes are scaled, its masses and inertias are not", "scaled-model"
    )
    return replace(model, links=tuple(_scaled_link(link, scale) for link in model.links))


def _scaled_link(link: Link, scale: Vector3) -> Link:
    return replace(
        link,
        visuals=tuple(replace(shape, geometry=scaled(shape.geometry, scale)) for shape in link.visuals),
        collisions=tuple(replace(shape, geometry=scaled(shape.geometry, scale)) for shape in link.collisions),
    )


def scaled(geometry: Geometry, scale: Vector3) -> Geometry:
    """Return a scaled shape; a radius is scaled by the largest factor, so that circles stay circles."""
    x, y, z = scale
    match geometry:
        case Box(size):
            return Box(_multiply(size, scale))
        case Sphere(radius):
            return Sphere(radius * max(scale))
        case Ellipsoid(radii):
            return Ellipsoid(_multiply(radii, scale))
        case Cylinder(radius, length):
            return Cylinder(radius * max(x, y), length * z)
        case Capsule(radius, length):
            return Capsule(radius * max(x, y), length * z)
        case Cone(radius, length):
            return Cone(radius * max(x, y), length * z)
        case Plane(normal, (width, height)):
            return Plane(normal, (width * x, height * y))
        case Polyline(outlines, height):
            return Polyline(tuple(tuple((u * x, v * y) for u, v in outline) for outline in outlines), height * z)
        case MeshFile():
            return replace(geometry, scale=_multiply(geometry.scale, scale))
        case Heightmap():
            return replace(geometry, size=_multiply(geometry.size, scale))
        case Empty():
            return geometry


def _multiply(a: Vector3, b: Vector3) -> Vector3:
    return a[0] * b[0], a[1] * b[1], a[2] * b[2]
