"""Properties of a world by path, such as `models/rp2w/links/chassis/inertial/mass`.

A part of a path is a field, or the name of an element of a list, or * for all its elements. Aliases exist for fields
whose names differ between files and structs.
"""

from collections.abc import Sequence
from typing import Any, TypeVar, cast

from msgspec import Struct
from msgspec.structs import replace

from trundle.base.diagnostics import UsageError, nearest
from trundle.spatial import Pose
from trundle.studies.plan_files.variation import Value

_T = TypeVar("_T")
ARGUMENTS = "arguments"
"""First part of the path of an argument of a xacro or launch file."""
PARAMETERS = "parameters"
"""First part of the path of a ROS parameter."""
TIME_STEP = "time_step"
"""The only property whose path has one part."""
_ALIASES: dict[str, tuple[str, ...]] = {
    "gravity": ("physics", "gravity"),
    TIME_STEP: ("physics", "max_step_size_s"),
}
_POSES = ("world_from_model", "model_from_link", "world_from_light", "link_from_visual", "link_from_collision",
          "link_from_com", "link_from_sensor")  # fmt: skip
_XYZ = ("x", "y", "z")
_POSE = (*_XYZ, "roll", "pitch", "yaw")
_COMPONENTS = {3: _XYZ, 4: ("r", "g", "b", "a")}


def is_property(name: str) -> bool:
    """True if a varied quantity is a property; False if it is a name defined by the plan."""
    return "/" in name or name == TIME_STEP


def with_property(world: _T, path: str, value: Value) -> _T:
    """Return the world with another value of a property; unchanged parts are shared.

    Raises:
        UsageError: unknown property, with the properties available, or a value of another type.
    """
    parts = path.strip("/").split("/")
    return cast(_T, _Path(path, value).replaced(world, parts, 0))


class _Path:
    def __init__(self, path: str, value: Value) -> None:
        self._path = path
        self._value = value

    def _fail(self, parts: Sequence[str], depth: int, available: Sequence[str]) -> UsageError:
        owner_path = "/".join(parts[:depth]) or "the world"
        closest = nearest(parts[depth], available) if len(available) > 1 else None
        hint = f"; the nearest is {closest!r}" if closest else ""
        return UsageError(
            f"{self._path}: {owner_path} has no {parts[depth]!r}{hint}; it has: {', '.join(available) or 'nothing'}"
        )

    def replaced(self, owner: object, parts: list[str], depth: int) -> object:
        """Return `owner` with the value at the remaining path."""
        if depth == len(parts):
            return self._converted(owner)
        part = parts[depth]
        if isinstance(owner, Pose):
            return self._pose(owner, parts, depth)
        if isinstance(owner, Struct):
            return self._struct(owner, parts, depth)
        if isinstance(owner, tuple) and owner and all(isinstance(part_value, Struct) for part_value in owner):
            return self._listed(owner, parts, depth)
        if isinstance(owner, tuple) and len(owner) in _COMPONENTS:
            names = _COMPONENTS[len(owner)]
            if part not in names:
                raise self._fail(parts, depth, names)
            at = names.index(part)
            return (*owner[:at], self.replaced(owner[at], parts, depth + 1), *owner[at + 1 :])
        raise self._fail(parts, depth, ())

    def _struct(self, owner: Struct, parts: list[str], depth: int) -> Struct:
        fields, part = owner.__struct_fields__, parts[depth]
        if depth == 0 and part in _ALIASES:
            return cast(Struct, self.replaced(owner, [*_ALIASES[part], *parts[1:]], 0))
        if part == "friction" and "mu2" in fields:
            return replace(owner, mu=self._number(owner, "mu"), mu2=self._number(owner, "mu2"))
        if part == "pose":
            part = next((name for name in _POSES if name in fields), part)
        if part == "friction" and "surface" in fields:
            return replace(owner, surface=self.replaced(getattr(owner, "surface"), parts, depth))  # noqa: B009
        if part not in fields:
            raise self._fail(parts, depth, [*(_ALIASES if depth == 0 else ()), *_names(owner)])
        return replace(owner, **{part: self.replaced(getattr(owner, part), parts, depth + 1)})

    def _number(self, owner: Struct, field: str) -> object:
        return self._converted(getattr(owner, field))

    def _listed(self, owner: tuple[Any, ...], parts: list[str], depth: int) -> tuple[object, ...]:
        part = parts[depth]
        if part == "*":
            return self._everywhere(owner, parts, depth + 1)
        names = [str(getattr(item, "name", i)) for i, item in enumerate(owner)]
        if part not in names:
            raise self._fail(parts, depth, [*names, "*"])
        at = names.index(part)
        return (*owner[:at], self.replaced(owner[at], parts, depth + 1), *owner[at + 1 :])

    def _everywhere(self, owners: tuple[Any, ...], parts: list[str], depth: int) -> tuple[object, ...]:
        """Replace the value in every element that has the property; at least one must have it."""
        replaced: list[object] = []
        missing: UsageError | None = None
        for owner in owners:
            try:
                replaced.append(self.replaced(owner, parts, depth))
            except UsageError as error:
                replaced.append(owner)
                missing = error
        if missing is not None and all(old is new for old, new in zip(owners, replaced, strict=True)):
            raise missing
        return tuple(replaced)

    def _pose(self, pose: Pose, parts: list[str], depth: int) -> Pose:
        if parts[depth] not in _POSE or depth + 1 != len(parts):
            raise self._fail(parts, depth, _POSE)
        numbers = pose.as_list()
        at = _POSE.index(parts[depth])
        numbers[at] = cast(float, self._converted(numbers[at]))
        return Pose.from_rpy(*numbers)

    def _converted(self, before: object) -> object:
        """Return the value, converted to the type of the one that it replaces."""
        value = self._value
        if isinstance(before, bool):
            return value if isinstance(value, bool) else self._refuse("true or false")
        if isinstance(before, int | float) or before is None:
            is_number = isinstance(value, int | float) and not isinstance(value, bool)
            if not is_number:
                self._refuse("a number")
            return float(cast(float, value)) if isinstance(before, float) else value
        if isinstance(before, str):
            return value if isinstance(value, str) else self._refuse("a text")
        if isinstance(before, Pose):
            return Pose.from_rpy(*self._numbers(6, "[x, y, z, roll, pitch, yaw]"))
        if isinstance(before, tuple) and len(before) in _COMPONENTS:
            return self._numbers(len(before), f"[{', '.join(_COMPONENTS[len(before)])}]")
        names = _names(before) if isinstance(before, Struct) else ()
        available = [str(getattr(item, "name", "")) for item in before] if isinstance(before, tuple) else names
        raise UsageError(f"{self._path} is no single value; go on with one of: {', '.join(available)}")

    def _numbers(self, count: int, form: str) -> tuple[float, ...]:
        parts = self._value if isinstance(self._value, tuple) else ()
        numbers = [float(part) for part in parts if isinstance(part, int | float) and not isinstance(part, bool)]
        return tuple(numbers) if len(numbers) == len(parts) == count else self._refuse(form)

    def _refuse(self, expected: str) -> Any:
        raise UsageError(f"{self._path} must be {expected}, not {self._value!r}")


def _names(owner: Struct) -> list[str]:
    """Return the names with which a path may continue."""
    names = ["pose" if name in _POSES else name for name in owner.__struct_fields__ if name not in ("at", "name")]
    return sorted({*names, *(["friction"] if "surface" in names or "mu2" in names else [])})
