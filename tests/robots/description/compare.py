"""Comparison of models with those that the real tools read."""

import math
from collections.abc import Iterator
from typing import Any

from trundle.base.xmlnode import XmlNode
from trundle.spatial import Pose

_UNLIMITED = 1e16
_LIMITS = (("axis", "lower", "upper"), ("axis2", "lower2", "upper2"))


def differences(
    actual: dict[str, Any], expected: dict[str, Any], tolerance: float, *, placed: bool = True
) -> Iterator[str]:
    """All differences between our model and theirs, including nested models.

    Args:
        actual: from `check --json`.
        expected: from the dump.
        tolerance: of numbers, absolute and relative.
        placed: compare the pose of the model; a <state>, which libsdformat does not apply, puts it elsewhere.
    """
    label = actual["name"]
    for field in ("static", "self_collide"):
        if actual[field] != expected[field]:
            yield f"{label}: {field} {actual[field]}, theirs {expected[field]}"
    if placed and not same_pose(actual["pose"], expected["pose"], tolerance):
        yield f"{label}: pose {actual['pose']}, theirs {expected['pose']}"
    if expected.get("canonical_link") and actual["canonical_link"] != expected["canonical_link"]:
        yield f"{label}: canonical link {actual['canonical_link']}, theirs {expected['canonical_link']}"
    if sorted(p["filename"] for p in actual["plugins"]) != sorted(p["filename"] for p in expected["plugins"]):
        yield f"{label}: plugins {actual['plugins']}, theirs {expected['plugins']}"
    if len(actual["frames"]) != expected["n_frames"]:
        yield f"{label}: {len(actual['frames'])} frames, theirs {expected['n_frames']}"
    for kind, compare in (("links", _link), ("joints", _joint)):
        yield from _compare_each(label, kind, actual[kind], expected[kind], compare, tolerance)
    inner = {model["name"]: model for model in expected.get("models", [])}
    if [model["name"] for model in actual["models"]] != list(inner):
        yield f"{label}: nested models {[m['name'] for m in actual['models']]}, theirs {list(inner)}"
    for model in actual["models"]:
        if model["name"] in inner:
            yield from differences(model, inner[model["name"]], tolerance, placed=placed)


def _compare_each(label: str, kind: str, actual: Any, expected: Any, compare: Any, tolerance: float) -> Iterator[str]:
    mine, other = {x["name"]: x for x in actual}, {x["name"]: x for x in expected}
    if mine.keys() != other.keys():
        extra, lacking = sorted(mine.keys() - other.keys()), sorted(other.keys() - mine.keys())
        yield f"{label}: {kind}: {extra} too many, {lacking} missing"
    for name in mine.keys() & other.keys():
        for difference in compare(mine[name], other[name], tolerance):
            yield f"{label}: {name}: {difference}"


def _link(actual: Any, expected: Any, tolerance: float) -> Iterator[str]:
    inertia = [expected["inertia"][key] for key in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")]
    if not close(actual["mass"], expected["mass"], tolerance):
        yield f"mass {actual['mass']}, theirs {expected['mass']}"
    if not all(close(a, b, tolerance) for a, b in zip(actual["inertia"], inertia, strict=True)):
        yield f"inertia {actual['inertia']}, theirs {inertia}"
    for mine, other in (("inertial_pose", "inertial_pose"), ("pose", "pose_model")):
        if not same_pose(actual[mine], expected[other], tolerance):
            yield f"{mine} {actual[mine]}, theirs {expected[other]}"
    for kind in ("visuals", "collisions"):
        if actual[kind] != len(expected[kind]):
            yield f"{actual[kind]} {kind}, theirs {len(expected[kind])}"
    if sorted(actual["sensors"]) != sorted(sensor["name"] for sensor in expected["sensors"]):
        yield f"sensors {actual['sensors']}, theirs {[sensor['name'] for sensor in expected['sensors']]}"


def _joint(actual: Any, expected: Any, tolerance: float) -> Iterator[str]:
    for field in ("type", "parent", "child"):
        if actual[field] != expected[field]:
            yield f"{field} {actual[field]}, theirs {expected[field]}"
    if not same_pose(actual["pose"], expected["pose_model"], tolerance):
        yield f"pose {actual['pose']}, theirs {expected['pose_model']}"
    for axis, lower, upper in _LIMITS:
        other = expected[axis]
        if actual[axis] is None or other is None:
            # Theirs keeps an <axis> written where the type has none.
            if (actual[axis] is None) != (other is None) and actual["type"] not in ("fixed", "ball"):
                yield f"{axis} {actual[axis]}, theirs {other}"
            continue
        length = math.hypot(*other["xyz_model"]) or 1.0
        if any(abs(a - b / length) > tolerance for a, b in zip(actual[axis], other["xyz_model"], strict=True)):
            yield f"{axis} {actual[axis]}, theirs {other['xyz_model']}"
        values = {lower: "lower", upper: "upper"}
        if axis == "axis":
            values |= {name: name for name in ("effort", "velocity")}
            values |= {name: name for name in ("damping", "friction", "spring_reference", "spring_stiffness")}
        for mine, name in values.items():
            if not _same_limit(actual[mine], other[name], name, tolerance):
                yield f"{mine} {actual[mine]}, theirs {other[name]}"


def _same_limit(actual: float | None, expected: float | str | None, name: str, tolerance: float) -> bool:
    if not isinstance(expected, float | int) or abs(expected) >= _UNLIMITED:
        return actual is None
    if name in ("effort", "velocity") and expected < 0:
        return actual is None
    return actual is not None and close(actual, float(expected), tolerance)


def close(actual: float, expected: float, tolerance: float) -> bool:
    """Return True if two numbers agree, absolutely or relatively."""
    return abs(actual - expected) <= tolerance * max(1.0, abs(actual), abs(expected))


def same_pose(actual: list[float], expected: Any, tolerance: float) -> bool:
    """Return True if x y z roll pitch yaw is their xyz and wxyz; poses that they could not resolve are skipped."""
    if "xyz" not in expected:
        return True
    pose = Pose.from_rpy(*actual)
    if not all(close(a, b, tolerance) for a, b in zip(pose.position, expected["xyz"], strict=True)):
        return False
    apart = (
        max(abs(a - sign * b) for a, b in zip(pose.quaternion, expected["wxyz"], strict=True)) for sign in (1.0, -1.0)
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
