"""Comparison of what is read back with what was to be saved."""

import math
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from msgspec import Struct

from trundle.robots.model import Model, World
from trundle.spatial import Pose

NEAR = 1e-7
"""Deviation of a number that counts as none."""
_IGNORED = frozenset({"at", "uri", "node", "added", "sdf_version", "plugins", "canonical_link", "frames"})
"""Fields without meaning for the state, or that the XML keeps by itself."""


def poses_differ(one: Pose, other: Pose) -> bool:
    """True if poses differ by more than rounding."""
    apart = math.dist(one.position, other.position)
    aligned = abs(sum(a * b for a, b in zip(one.quaternion, other.quaternion, strict=True)))
    return apart > NEAR * max(1.0, *map(abs, one.position)) or 1.0 - aligned > NEAR


def differences(have: World, want: World) -> list[str]:
    """Return what differs between two flat worlds, each as `model 'cart': links.base.inertial.mass`."""
    found: list[str] = []
    for kind, ours, theirs in (("model", have.models, want.models), ("light", have.lights, want.lights)):
        there, wanted = {each.name: each for each in ours}, {each.name: each for each in theirs}
        found += [f"{kind} {name!r}" for name in there.keys() ^ wanted.keys()]
        for name in there.keys() & wanted.keys():
            found += [f"{kind} {name!r}: {path}" for path in different_fields(there[name], wanted[name])]
    for name in ("physics", "wind", "scene"):
        found += [".".join([name, path]).rstrip(".") for path in _paths(getattr(have, name), getattr(want, name))]
    found += [f"joint {name!r}" for name in {j.name for j in have.joints} ^ {j.name for j in want.joints}]
    return sorted(found)


def different_fields(have: Struct, want: Struct) -> list[str]:
    """Return the dotted names of what differs between two parts of a world."""
    return list(_paths(have, want))


def has_joint(model: Model, link: str) -> bool:
    """True if a link of a model is an end of a joint."""
    return any(link in (joint.parent, joint.child) for joint in model.joints)


def _paths(have: Any, want: Any) -> Iterable[str]:
    match have, want:
        case Pose(), Pose():
            different = poses_differ(have, want)
        case Struct(), Struct() if type(have) is type(want):
            for name in have.__struct_fields__:
                if name not in _IGNORED:
                    for path in _paths(getattr(have, name), getattr(want, name)):
                        yield f"{name}.{path}".rstrip(".")
            return
        case float() | int(), float() | int():
            different = not (have == want or math.isclose(have, want, rel_tol=NEAR, abs_tol=NEAR * NEAR))
        case Path(), Path():
            different = have.resolve() != want.resolve()
        case (list() | tuple(), list() | tuple()) if len(have) == len(want):
            yield from _in_order(have, want)
            return
        case _:
            different = have is not want and bool(have != want)
    if different:
        yield ""


def _in_order(have: Sequence[Any], want: Sequence[Any]) -> Iterable[str]:
    for number, (one, other) in enumerate(zip(have, want, strict=True)):
        name = getattr(one, "name", str(number))
        for path in _paths(one, other):
            yield f"{name}.{path}".rstrip(".")
