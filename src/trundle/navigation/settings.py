"""Parameters of a plugin as a struct: read from the ROS graph, set at run time by dynamic_reconfigure."""

from collections.abc import Callable
from typing import Any, TypeVar, cast, get_type_hints

import msgspec

from trundle.robots.parameters import RosParameters
from trundle.ros import Node, Option, Options, ReconfigureServer

_Settings = TypeVar("_Settings", bound=msgspec.Struct)
_READERS: dict[type, str] = {bool: "flag", int: "integer", float: "number", str: "text"}


def read_settings(kind: type[_Settings], *parameters: RosParameters) -> _Settings:
    """Read a struct's fields; each from the first namespace that has it, else its default.

    Raises:
        ParamError: a value has another type, or is outside the bounds of the field's `msgspec.Meta`.
    """
    defaults = kind()
    values: dict[str, Any] = {}
    for name in kind.__struct_fields__:
        default = getattr(defaults, name)
        section = next((section for section in parameters if name in section), None)
        if section is not None:
            value = getattr(section, _READERS[type(default)])(name, default=default)
            if not isinstance(default, bool | str):
                value = type(default)(section.clamped(name, value, *_bounds(kind, name)))
            values[name] = value
    return kind(**values)


def reconfigure(node: Node, namespace: str, settings: msgspec.Struct, apply: Callable[[], object]) -> ReconfigureServer:
    """Serve a struct's fields by dynamic_reconfigure; `apply` is called after each change."""

    def change(options: Options) -> Options:
        for name, value in options.items():
            setattr(settings, name, value)
        apply()
        return options

    kind = type(settings)
    options: list[Option] = []
    for name in kind.__struct_fields__:
        lower, upper = _bounds(kind, name)
        options.append(Option(name=name, value=getattr(settings, name), lower=lower, upper=upper))
    return ReconfigureServer(node, options, change, namespace=namespace)


def _bounds(kind: type[msgspec.Struct], name: str) -> tuple[float, float]:
    """Return the bounds of a field, as its `msgspec.Meta` says."""
    metas = getattr(get_type_hints(kind, include_extras=True)[name], "__metadata__", ())
    meta = cast("msgspec.Meta | None", metas[0] if metas else None)
    lower = float("-inf") if meta is None or meta.ge is None else float(meta.ge)
    upper = float("inf") if meta is None or meta.le is None else float(meta.le)
    return lower, upper
