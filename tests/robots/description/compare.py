"""Comparison of models with those that the real tools read."""

import math
from collections.abc import Iterator
from typing import Any

from trundle.base.xmlnode import XmlNode
from trundle.spatial import Pose

_UNLIMITED = 1e16
_LIMITS = (("axis", "lower", "upper"), ("axis2", "lower2", "upper2"))


def differences(
    ours: dict[str, Any], theirs: dict[str, Any], tolerance: float, *, placed: bool = True
) -> Iterator[str]:
    """All differences between our model and theirs, including nested models.

    Args:
        ours: from `check --json`.
        theirs: from the dump.
        tolerance: of numbers, absolute and relative.
        placed: compare the pose of the model; a <state>, which libsdformat does not apply, puts it elsewhere.
    """
    who = ours["name"]
    for field in ("static", "self_collide"):
        if ours[field] != theirs[field]:
            yield f"{who}: {field} {ours[field]}, theirs {theirs[field]}"
    if placed and not same_pose(ours["pose"], theirs["pose"], tolerance):
        yield f"{who}: pose {ours['pose']}, theirs {theirs['pose']}"
    if theirs.get("canonical_link") and ours["canonical_link"] != theirs["canonical_link"]:
        yield f"{who}: canonical link {ours['canonical_link']}, theirs {theirs['canonical_link']}"
    if sorted(p["filename"] for p in ours["plugins"]) != sorted(p["filename"] for p in theirs["plugins"]):
        yield f"{who}: plugins {ours['plugins']}, theirs {theirs['plugins']}"
    if len(ours["frames"]) != theirs["n_frames"]:
        yield f"{who}: {len(ours['frames'])} frames, theirs {theirs['n_frames']}"
    for kind, compare in (("links", _link), ("joints", _joint)):
        yield from _each(who, kind, ours[kind], theirs[kind], compare, tolerance)
    inner = {model["name"]: model for model in theirs.get("models", [])}
    if [model["name"] for model in ours["models"]] != list(inner):
        yield f"{who}: nested models {[m['name'] for m in ours['models']]}, theirs {list(inner)}"
    for model in ours["models"]:
        if model["name"] in inner:
            yield from differences(model, inner[model["name"]], tolerance, placed=placed)


def _each(who: str, kind: str, ours: Any, theirs: Any, compare: Any, tolerance: float) -> Iterator[str]:
    mine, other = {x["name"]: x for x in ours}, {x["name"]: x for x in theirs}
    if mine.keys() != other.keys():
        extra, lacking = sorted(mine.keys() - other.keys()), sorted(other.keys() - mine.keys())
        yield f"{who}: {kind}: {extra} too many, {lacking} missing"
    for name in mine.keys() & other.keys():
        for what in compare(mine[name], other[name], tolerance):
            yield f"{who}: {name}: {what}"


def _link(ours: Any, theirs: Any, tolerance: float) -> Iterator[str]:
    inertia = [theirs["inertia"][key] for key in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")]
    if not close(ours["mass"], theirs["mass"], tolerance):
        yield f"mass {ours['mass']}, theirs {theirs['mass']}"
    if not all(close(a, b, tolerance) for a, b in zip(ours["inertia"], inertia, strict=True)):
        yield f"inertia {ours['inertia']}, theirs {inertia}"
    for mine, other in (("inertial_pose", "inertial_pose"), ("pose", "pose_model")):
        if not same_pose(ours[mine], theirs[other], tolerance):
            yield f"{mine} {ours[mine]}, theirs {theirs[other]}"
    for kind in ("visuals", "collisions"):
        if ours[kind] != len(theirs[kind]):
            yield f"{ours[kind]} {kind}, theirs {len(theirs[kind])}"
    if sorted(ours["sensors"]) != sorted(sensor["name"] for sensor in theirs["sensors"]):
        yield f"sensors {ours['sensors']}, theirs {[sensor['name'] for sensor in theirs['sensors']]}"


def _joint(ours: Any, theirs: Any, tolerance: float) -> Iterator[str]:
    for field in ("type", "parent", "child"):
        if ours[field] != theirs[field]:
            yield f"{field} {ours[field]}, theirs {theirs[field]}"
    if not same_pose(ours["pose"], theirs["pose_model"], tolerance):
        yield f"pose {ours['pose']}, theirs {theirs['pose_model']}"
    for axis, lower, upper in _LIMITS:
        other = theirs[axis]
        if ours[axis] is None or other is None:
            # Theirs keeps an <axis> written where the type has none.
            if (ours[axis] is None) != (other is None) and ours["type"] not in ("fixed", "ball"):
                yield f"{axis} {ours[axis]}, theirs {other}"
            continue
        length = math.hypot(*other["xyz_model"]) or 1.0
        if any(abs(a - b / length) > tolerance for a, b in zip(ours[axis], other["xyz_model"], strict=True)):
            yield f"{axis} {ours[axis]}, theirs {other['xyz_model']}"
        values = {lower: "lower", upper: "upper"}
        if axis == "axis":
            values |= {name: name for name in ("effort", "velocity")}
            values |= {name: name for name in ("damping", "friction", "spring_reference", "spring_stiffness")}
        for mine, name in values.items():
            if not _same_limit(ours[mine], other[name], name, tolerance):
                yield f"{mine} {ours[mine]}, theirs {other[name]}"


def _same_limit(ours: float | None, theirs: float | str | None, name: str, tolerance: float) -> bool:
    none = not isinstance(theirs, float | int) or abs(theirs) >= _UNLIMITED
    if none or (name in ("effort", "velocity") and float(theirs) < 0):
        return ours is None
    return ours is not None and close(ours, float(theirs), tolerance)


def close(ours: float, theirs: float, tolerance: float) -> bool:
    """Return True if two numbers agree, absolutely or relatively."""
    return abs(ours - theirs) <= tolerance * max(1.0, abs(ours), abs(theirs))


def same_pose(ours: list[float], theirs: Any, tolerance: float) -> bool:
    """Return True if x y z roll pitch yaw is their xyz and wxyz; poses that they could not resolve are skipped."""
    if "xyz" not in theirs:
        return True
    pose = Pose.from_rpy(*ours)
    if not all(close(a, b, tolerance) for a, b in zip(pose.position, theirs["xyz"], strict=True)):
        return False
    apart = (
        max(abs(a - sign * b) for a, b in zip(pose.quaternion, theirs["wxyz"], strict=True)) for sign in (1.0, -1.0)
    )
    return min(apart) <= 2 * tolerance


def shape_of(node: XmlNode) -> tuple[object, ...]:
    """An element as nested tuples, numbers as numbers."""

    def value(text: str) -> object:
        try:
            return tuple(float(word) for word in text.split())
        except ValueError:
            return text

    attributes = {k: value(v) for k, v in node.attributes().items()}
    return node.tag, tuple(sorted(attributes.items())), value(node.text), tuple(map(shape_of, node.children))
