"""Comparison of a saved world, read back, with the world to be saved."""

import math
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from msgspec import Struct

from trundle.robots.model import Model, World
from trundle.spatial import Pose

TOLERANCE = 1e-7
"""Relative difference of numbers that count as equal."""
_IGNORED = frozenset({"at", "uri", "node", "added", "sdf_version", "plugins", "canonical_link", "frames"})
"""Fields that are not compared: they are no part of the state, or are copied unchanged from the original XML."""


def poses_differ(one: Pose, other: Pose) -> bool:
    """True if poses differ by more than rounding."""
    distance = math.dist(one.position, other.position)
    alignment = abs(sum(a * b for a, b in zip(one.quaternion, other.quaternion, strict=True)))
    return distance > TOLERANCE * max(1.0, *map(abs, one.position)) or 1.0 - alignment > TOLERANCE


def differences(current: World, target: World) -> list[str]:
    """Return the differences between two flat worlds, each as `model 'cart': links.base.inertial.mass`."""
    differing: list[str] = []
    for kind, one, other in (
        ("model", current.models, target.models),
        ("light", current.lights, target.lights),
    ):
        before, after = (
            {part.name: part for part in one},
            {part.name: part for part in other},
        )
        differing += [f"{kind} {name!r}" for name in before.keys() ^ after.keys()]
        for name in before.keys() & after.keys():
            differing += [f"{kind} {name!r}: {path}" for path in different_fields(before[name], after[name])]
    for name in ("physics", "wind", "scene"):
        differing += [
            ".".join([name, path]).rstrip(".") for path in _paths(getattr(current, name), getattr(target, name))
        ]
    differing += [f"joint {name!r}" for name in {j.name for j in current.joints} ^ {j.name for j in target.joints}]
    return sorted(differing)


def different_fields(current: Struct, target: Struct) -> list[str]:
    """Return the dotted names of the fields that differ between two parts of a world."""
    return list(_paths(current, target))


def has_joint(model: Model, link: str) -> bool:
    """True if a joint connects a link of a model."""
    return any(link in (joint.parent, joint.child) for joint in model.joints)


def _paths(current: Any, target: Any) -> Iterable[str]:
    match current, target:
        case Pose(), Pose():
            different = poses_differ(current, target)
        case Struct(), Struct() if type(current) is type(target):
            for name in current.__struct_fields__:
                if name not in _IGNORED:
                    for path in _paths(getattr(current, name), getattr(target, name)):
                        yield f"{name}.{path}".rstrip(".")
            return
        case float() | int(), float() | int():
            different = not (
                current == target or math.isclose(current, target, rel_tol=TOLERANCE, abs_tol=TOLERANCE * TOLERANCE)
            )
        case Path(), Path():
            different = current.resolve() != target.resolve()
        case (list() | tuple(), list() | tuple()) if len(current) == len(target):
            yield from _in_order(current, target)
            return
        case _:
            different = current is not target and bool(current != target)
    if different:
        yield ""


def _in_order(current: Sequence[Any], target: Sequence[Any]) -> Iterable[str]:
    for number, (one, other) in enumerate(zip(current, target, strict=True)):
        name = getattr(one, "name", str(number))
        for path in _paths(one, other):
            yield f"{name}.{path}".rstrip(".")
