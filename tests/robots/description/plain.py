"""Models as plain values, to compare them field by field."""

import math
from collections.abc import Iterator
from typing import Any

from msgspec import Struct

from trundle.base.xmlnode import XmlNode
from trundle.spatial import Pose

_WHERE = ("at", "sdf_version")
_CLOSE = 1e-9


def plain(value: Any) -> Any:
    """A struct as plain values, without source positions; a plugin as its XML."""
    if isinstance(value, XmlNode):
        return value.xml()
    if isinstance(value, Pose):
        return value
    if isinstance(value, Struct):
        return {name: plain(getattr(value, name)) for name in value.__struct_fields__ if name not in _WHERE}
    return [plain(item) for item in value] if isinstance(value, tuple) else value


def unlike(a: Any, b: Any, path: str = "") -> Iterator[str]:
    """The fields in which two models differ by more than 1e-9, as `models/links/name`."""
    if isinstance(a, Pose) and isinstance(b, Pose):
        turned = min(math.dist(a.quaternion, [sign * value for value in b.quaternion]) for sign in (1, -1))
        if turned > _CLOSE or math.dist(a.position, b.position) > _CLOSE * max(1.0, *map(abs, a.position)):
            yield path
    elif isinstance(a, dict) and isinstance(b, dict) and a.keys() == b.keys():
        for key in a:
            yield from unlike(a[key], b[key], f"{path}/{key}".lstrip("/"))
    elif isinstance(a, list) and isinstance(b, list) and len(a) == len(b):
        for x, y in zip(a, b, strict=True):
            yield from unlike(x, y, path)
    elif isinstance(a, float) and isinstance(b, float):
        if not math.isclose(a, b, rel_tol=_CLOSE, abs_tol=_CLOSE):
            yield path
    elif a != b:
        yield path
