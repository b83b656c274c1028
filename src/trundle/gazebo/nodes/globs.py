"""Patterns of the topics and services that clients may use."""

from fnmatch import fnmatchcase

from trundle.robots.parameters import ParamError


def read_globs(value: object, where: str) -> tuple[str, ...]:
    """Patterns of a parameter, a list or a text like "['/a', '/b*']"; empty: everything.

    Raises:
        ParamError: neither.
    """
    if isinstance(value, list):
        parts = [str(item) for item in value]  # pyright: ignore[reportUnknownVariableType, reportUnknownArgumentType]
    elif isinstance(value, str):
        parts = value.strip().removeprefix("[").removesuffix("]").split(",")
    else:
        raise ParamError(f"parameter {where}: {value!r} is not a list of patterns like '[/scan, /camera/*]'")
    return tuple(part for part in (each.strip().strip("'\"") for each in parts) if part)


def allows(globs: tuple[str, ...], name: str) -> bool:
    """True if a pattern matches the name, or there are none."""
    return not globs or any(fnmatchcase(name, glob) for glob in globs)
