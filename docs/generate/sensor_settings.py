"""Reference of sensors' settings: type, default, SDF element and meaning of each, generated from the code."""

import ast
import inspect
import re
import types
from collections.abc import Iterator
from functools import cache
from itertools import pairwise, takewhile
from pathlib import Path
from typing import Any, Union, get_args, get_origin, get_type_hints
from xml.etree import ElementTree

import msgspec

from trundle.base.diagnostics import Diagnostics
from trundle.robots import model
from trundle.robots.description import Link
from trundle.robots.description.builder.sensors import SETTINGS, SensorSettings, make_sensor
from trundle.robots.description.writing.sdf.sensor import add_sensor
from trundle.robots.description.writing.tag import Tag
from trundle.robots.model import Noise
from trundle.spatial import Pose

from .markdown import cell, code, html, table

_INTRO = """# Settings of sensors

[Sensors](../sensors.md) has the topics of each type. In a file, an element below is a child of `<sensor>`;
`a/b` is `<b>` in `<a>`. In Python, settings are structs of `trundle`, the third argument of
[`Link.add_sensor`](python.md#trundle.Link.add_sensor):

```python
import trundle

world = trundle.World("yard")
mast = world.add_model("mast").add_box("pole", (0.1, 0.1, 1.0))
turn = trundle.ScanAxis(samples=360, min_angle=-3.14, max_angle=3.14)
scan = trundle.RangeScan(horizontal=turn, min_m=0.1, max_m=8.0)
mast.add_sensor("lidar", "ray", scan, update_rate=10.0)
mast.add_sensor("imu", "imu", trundle.ImuNoise(linear_acceleration=(trundle.Noise(stddev=0.02),) * 3))
```

Types of an image have the settings of a camera. `contact`, `rfid` and `rfidtag` have only those of every sensor.
A `force_torque` sensor is added to a joint, by `Joint.add_force_torque_sensor`.
"""
_HEAD = ("Setting", "Type", "Default", "Element", "Meaning")
_COMMON = ("pose", "update_rate", "always_on", "visualize", "topic")
"""Arguments of `Link.add_sensor` for every type."""
_STRUCTS = Path(inspect.getfile(model)).parent
_NO_DEFAULT = "required"
_EXAMPLE_OF_TYPE = {float: 0.375, int: 7, bool: True, str: "other"}
Struct = type[msgspec.Struct]


def page() -> str:
    """Return the page: what every sensor has, each type's settings, and the structs in them."""
    parts = [_INTRO, "## Every sensor { #every-sensor }\n", table(_HEAD, _common_rows())]
    for settings in dict.fromkeys(SETTINGS.values()):
        names = ", ".join(f"`{name}`" for name in sorted(SETTINGS) if SETTINGS[name] is settings)
        parts += _section(settings, f"Of {names}. ", dict(_written_settings(settings)))
    for struct, elements in _inner_structs().items():
        parts += _section(struct, "", elements)
    return "\n".join(parts)


def settings() -> Iterator[tuple[Struct, str, str, str]]:
    """Yield struct, field, SDF element and meaning of each setting."""
    found = {struct: dict(_written_settings(struct)) for struct in dict.fromkeys(SETTINGS.values())}
    for struct, elements in {**found, **_inner_structs()}.items():
        for field in msgspec.structs.fields(struct):
            yield struct, field.name, elements.get(field.name, ""), _meanings(struct).get(field.name, "")


def with_other_numbers(struct: Struct) -> msgspec.Struct:
    """Return a struct whose numbers, also those of inner structs, are not the defaults."""

    def other(value: Any) -> Any:
        if isinstance(value, Pose):
            return Pose((1.0, 2.0, 3.0))
        if isinstance(value, msgspec.Struct):
            return type(value)(**{name: other(getattr(value, name)) for name in value.__struct_fields__})
        if isinstance(value, tuple):
            return tuple(other(part) for part in value)
        if isinstance(value, bool):
            return not value
        if isinstance(value, int):
            return value ^ 2
        return 1.5 * value + 0.25 if isinstance(value, float) else value

    made: msgspec.Struct = other(struct())
    return made


def _section(struct: Struct, start: str, elements: dict[str, str]) -> list[str]:
    rows = [
        (
            code(field.name),
            _type_html(_hints(struct)[field.name]),
            html(_default(field)),
            code(elements[field.name]) if elements.get(field.name) else "",
            html(_meanings(struct).get(field.name, "")),
        )
        for field in msgspec.structs.fields(struct)
    ]
    name, text = struct.__name__, cell(inspect.cleandoc(struct.__doc__ or ""))
    return [f"## {name} {{ #{name} }}\n", f"{start}{text}\n", table(_HEAD, rows)]


def _common_rows() -> Iterator[tuple[str, ...]]:
    meanings = dict(re.findall(r"^    (\w+): (.*)$", inspect.cleandoc(Link.add_sensor.__doc__ or ""), re.MULTILINE))
    bare = _elements("camera", None)
    for name in _COMMON:
        parameter = inspect.signature(Link.add_sensor).parameters[name]
        kind = "Pose" if name == "pose" else type(parameter.default).__name__
        value = Pose((1.0, 2.0, 3.0)) if name == "pose" else _EXAMPLE_OF_TYPE[type(parameter.default)]
        element = _changed(bare, _elements("camera", None, **{name: value}))
        default = "Pose()" if name == "pose" else repr(parameter.default)
        yield code(name), code(kind), code(default), code(element), html(meanings[name])


def _written_settings(struct: type[SensorSettings]) -> Iterator[tuple[str, str]]:
    """Yield each field and the element that the writer of SDF changes with it."""
    type_ = next(name for name, settings in SETTINGS.items() if settings is struct)
    for field in msgspec.structs.fields(struct):
        before, after = _pair(struct, field.name, struct() if _is_nested(struct, field.name) else _made(struct))
        yield field.name, _changed(_elements(type_, before), _elements(type_, after))


@cache
def _inner_structs() -> dict[Struct, dict[str, str]]:
    """Return the structs that are values of settings, with the elements of their fields in that of the setting."""
    found: dict[Struct, dict[str, str]] = {}
    for settings in dict.fromkeys(SETTINGS.values()):
        type_ = next(name for name, one in SETTINGS.items() if one is settings)
        for field in msgspec.structs.fields(settings):
            for struct in _structs_in(_hints(settings)[field.name]):
                if struct not in found:
                    found[struct] = dict(_inner_elements(type_, settings, field.name, struct))
    return found


def _inner_elements(type_: str, settings: type[SensorSettings], name: str, struct: Struct) -> Iterator[tuple[str, str]]:
    hint = _hints(settings)[name]

    def written(value: msgspec.Struct) -> dict[str, str]:
        whole = (value, value, value) if get_origin(hint) is tuple else value
        return _elements(type_, settings(**{name: whole}))

    start = _made(struct)
    home = _changed(_elements(type_, settings()), written(start)).split("/")
    for field in msgspec.structs.fields(struct):
        before, after = _pair(struct, field.name, start)
        parts = _changed(written(before), written(after)).split("/")
        shared = len(list(takewhile(lambda pair: pair[0] == pair[1], zip(home, parts, strict=False))))
        yield field.name, "/".join(parts[shared:])


def _pair(struct: Struct, name: str, start: Any) -> tuple[Any, Any]:
    """Return two structs that differ in a field."""
    return start, msgspec.structs.replace(start, **{name: _other(_hints(struct)[name], getattr(start, name))})


def _is_nested(struct: Struct, name: str) -> bool:
    return any(True for _ in _structs_in(_hints(struct)[name]))


def _made(struct: Struct) -> msgspec.Struct:
    """Return a struct that is not the default one."""
    values = {field.name: _other(_hints(struct)[field.name], None) for field in msgspec.structs.fields(struct)}
    return struct(**values)


def _other(hint: Any, value: object) -> Any:
    """Return a value of a type that differs from another."""
    if get_origin(hint) in (Union, types.UnionType):
        hint = next(part for part in get_args(hint) if part is not type(None))
    if get_origin(hint) is tuple:
        found = tuple(_other(part, None) for part in get_args(hint))
        return (
            tuple(_other(part, one) for part, one in zip(get_args(hint), found, strict=True))
            if found == value
            else found
        )
    if hint is Pose:
        return Pose((3.0, 2.0, 1.0)) if value == Pose((1.0, 2.0, 3.0)) else Pose((1.0, 2.0, 3.0))
    if hint is bool:
        return value is not True
    if inspect.isclass(hint) and issubclass(hint, msgspec.Struct):
        return _made(hint)
    example: Any = _EXAMPLE_OF_TYPE[hint]
    return example * 2 if value == example else example


def _elements(type_: str, settings: SensorSettings | None, **common: Any) -> dict[str, str]:
    """Return the texts and attributes of a sensor's SDF, by path."""
    given = {"pose": Pose(), "update_rate": 0.0, "always_on": False, "visualize": False, "topic": ""} | common
    home = Tag("link")
    add_sensor(home, make_sensor("s", type_, settings, **given), Diagnostics())
    found: dict[str, str] = {}

    def walk(node: ElementTree.Element, path: str) -> None:
        for child in node:
            below = f"{path}/{child.tag}".removeprefix("/")
            found[below] = (child.text or "").strip()
            found.update({f'{below} {key}="…"': value for key, value in child.attrib.items()})
            walk(child, below)

    sensor = ElementTree.fromstring("\n".join(home.lines())).find("sensor")
    assert sensor is not None
    walk(sensor, "")
    return found


def _changed(before: dict[str, str], after: dict[str, str]) -> str:
    """Return the path of the element that differs: the common one of several; empty: none."""
    paths = sorted(path for path in before.keys() | after.keys() if before.get(path) != after.get(path))
    if not paths:
        return ""
    if len(paths) == 1:
        return paths[0]
    split = [path.partition(" ")[0].split("/") for path in paths]
    same = takewhile(lambda parts: len(set(parts)) == 1, zip(*split, strict=False))
    return "/".join(parts[0] for parts in same)


def _structs_in(hint: Any) -> Iterator[Struct]:
    for part in (hint, *get_args(hint)):
        if inspect.isclass(part) and issubclass(part, msgspec.Struct) and part is not Pose:
            yield part


@cache
def _hints(struct: Struct) -> dict[str, Any]:
    return get_type_hints(struct)


def _type_html(hint: Any) -> str:
    if get_origin(hint) in (Union, types.UnionType):
        return " or ".join(_type_html(part) for part in get_args(hint))
    if get_origin(hint) is tuple:
        parts = get_args(hint)
        return f"{len(parts)} × {_type_html(parts[0])}"
    if hint is type(None):
        return code("None")
    name = hint.__name__
    return f'<a href="#{name}">{code(name)}</a>' if hint in _inner_structs() else code(name)


def _default(field: msgspec.structs.FieldInfo) -> str:
    if field.required:
        return _NO_DEFAULT
    value: Any = field.default
    if isinstance(value, tuple) and value == (Noise(),) * len(value):
        return "no noise"
    if isinstance(value, msgspec.Struct):
        return "no noise" if value == Noise() else f"`{type(value).__name__}()`"
    return f"`{value:#x}`" if isinstance(value, int) and value > 0xFFFF else f"`{value!r}`"


@cache
def _meanings(struct: Struct) -> dict[str, str]:
    """Return the docstring below each field."""
    found: dict[str, str] = {}
    body = _definitions()[struct.__name__].body
    for part, after in pairwise(body):
        if isinstance(part, ast.AnnAssign) and isinstance(after, ast.Expr) and isinstance(after.value, ast.Constant):
            found[ast.unparse(part.target)] = str(after.value.value)
    return found


@cache
def _definitions() -> dict[str, ast.ClassDef]:
    """Return the definitions of the structs by name: their `__module__` is not where they are."""
    trees = [ast.parse(file.read_text(encoding="utf-8")) for file in sorted(_STRUCTS.glob("*.py"))]
    return {node.name: node for tree in trees for node in tree.body if isinstance(node, ast.ClassDef)}
