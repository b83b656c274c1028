"""Glob patterns of the topics and services that clients may use."""

from fnmatch import fnmatchcase

from trundle.robots.parameters import ParamError


def read_globs(value: object, parameter: str) -> tuple[str, ...]:
    """Read the patterns in a parameter, a list or a text like "['/a', '/b*']"; empty: all names.

    Raises:
        ParamError: it is neither.
    """
    if isinstance(value, list):
        parts = [str(item) for item in value]
    elif isinstance(value, str):
        parts = value.strip().removeprefix("[").removesuffix("]").split(",")
    else:
        raise ParamError(f"parameter {parameter}: {value!r} is not a list of patterns like '[/scan, /camera/*]'")
    return tuple(part for part in (item.strip().strip("'\"") for item in parts) if part)


def allows(globs: tuple[str, ...], name: str) -> bool:
    """Return True if a pattern matches the name, or without patterns."""
    return not globs or any(fnmatchcase(name, glob) for glob in globs)
