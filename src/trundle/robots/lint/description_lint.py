"""Lint of inertias, overlaps and undriven joints."""

import math
import re

from trundle.base.diagnostics import Diagnostics
from trundle.robots.description import LoadedDescription
from trundle.robots.model import (
    Box,
    Capsule,
    Cylinder,
    Ellipsoid,
    Geometry,
    Inertial,
    JointType,
    Link,
    Model,
    Sphere,
    flattened,
)
from trundle.spatial import Pose

from .overlaps import report_overlaps

_MAX_MOMENT_RATIO = 2.0
"""Maximum moment of inertia, relative to the largest that the mass could have within the link's shapes."""
_MIN_MOMENT_RATIO = 1e-4
"""Minimum of this ratio."""
_PASSIVE = frozenset({JointType.FIXED, JointType.BALL})
_TRANSMISSION = re.compile(r"<transmission\b.*?</transmission>", re.DOTALL)


def lint_description(loaded: LoadedDescription, report: Diagnostics) -> None:
    """Report inertias that do not fit their link, overlapping bodies and undriven joints."""
    driven = " ".join(_TRANSMISSION.findall(loaded.urdf or ""))
    models = flattened(loaded.world).models
    report_overlaps(models, report)
    for model in models:
        if model.static:
            continue
        for link in model.links:
            _lint_inertia(link, report)
        _lint_joints(model, driven, report)


def _lint_inertia(link: Link, report: Diagnostics) -> None:
    inertial = link.inertial
    reach = _reach(link)
    if reach is None or not inertial.mass > 0.0:
        return
    limit = inertial.mass * reach * reach
    largest = max(inertial.moments)
    if largest > _MAX_MOMENT_RATIO * limit:
        report.warn(
            link.at,
            f"link {link.name!r}: a moment of inertia of {largest:g} kg·m² is too large for {inertial.mass:g} kg "
            f"within {reach:.3g} m (at most {limit:.3g}); it will turn far too slowly",
            "implausible-inertia",
        )
    elif 0.0 < largest < _MIN_MOMENT_RATIO * limit:
        report.warn(
            link.at,
            f"link {link.name!r}: moments of inertia of at most {largest:g} kg·m² are tiny for {inertial.mass:g} kg "
            f"within {reach:.3g} m ({limit:.3g} would be the largest); it may jitter",
            "implausible-inertia",
        )


def _reach(link: Link) -> float | None:
    """Return the largest distance of the link's shapes from the centre of mass [m]; None if unknown."""
    shapes = [(shape.geometry, shape.link_from_collision) for shape in link.collisions]
    shapes = shapes or [(shape.geometry, shape.link_from_visual) for shape in link.visuals]
    reaches = [_shape_reach(geometry, pose, link.inertial) for geometry, pose in shapes]
    known = [reach for reach in reaches if reach is not None]
    return max(known) if known and len(known) == len(reaches) else None


def _shape_reach(geometry: Geometry, pose: Pose, inertial: Inertial) -> float | None:
    match geometry:
        case Box(size):
            half = math.hypot(*size) / 2
        case Cylinder(radius, length):
            half = math.hypot(radius, length / 2)
        case Capsule(radius, length):
            half = radius + length / 2
        case Sphere(radius):
            half = radius
        case Ellipsoid(radii):
            half = max(radii)
        case _:
            return None
    return half + math.dist(pose.position, inertial.link_from_com.position)


def _lint_joints(model: Model, driven: str, report: Diagnostics) -> None:
    names_text = driven + " ".join(plugin.node.xml() for plugin in model.plugins)
    idle = [
        joint.name
        for joint in model.joints
        if joint.type not in _PASSIVE
        and not (joint.axis is not None and (joint.axis.is_rigid or joint.axis.mimic is not None))
        and not re.search(rf"\b{re.escape(joint.name)}\b", names_text)
    ]
    if idle:
        names = ", ".join(map(repr, idle[:8])) + (f" and {len(idle) - 8} more" if len(idle) > 8 else "")
        report.info(
            model.at,
            f"model {model.name!r}: no plugin or transmission here names {names}; they move freely",
            "undriven-joints",
        )
