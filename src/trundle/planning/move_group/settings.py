"""Parameters as a struct."""

from typing import Any, TypeVar, get_type_hints

import msgspec

from trundle.robots.parameters import RosParameters

_Settings = TypeVar("_Settings", bound=msgspec.Struct)
_READERS: dict[type, str] = {bool: "flag", int: "integer", float: "number", str: "text"}


def read_settings(kind: type[_Settings], parameters: RosParameters) -> _Settings:
    """Read a struct's fields; those that are not set have its defaults.

    Raises:
        ParamError: a value has another type, or is outside the bounds of the field's `msgspec.Meta`.
    """
    defaults = kind()
    values: dict[str, Any] = {}
    hints = get_type_hints(kind, include_extras=True)
    for name in kind.__struct_fields__:
        if name not in parameters:
            continue
        default = getattr(defaults, name)
        value = getattr(parameters, _READERS[type(default)])(name, default=default)
        meta = next(iter(getattr(hints[name], "__metadata__", ())), None)
        if meta is not None and not isinstance(default, bool | str):
            lower = float("-inf") if meta.ge is None else float(meta.ge)
            upper = float("inf") if meta.le is None else float(meta.le)
            value = type(default)(parameters.clamped(name, value, lower, upper))
        values[name] = value
    return kind(**values)
