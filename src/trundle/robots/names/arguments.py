"""Command-line arguments of ROS 1 executables: `a:=b`, `__name:=n`, `_param:=value`."""

import re
from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import NamedTuple

_REMAP = re.compile(r"(?P<from>(?:[~/A-Za-z]|__?)[A-Za-z0-9_/]*):=(?P<to>.*)", re.DOTALL)


class Arguments(NamedTuple):
    """Parsed command line: ROS arguments, and the rest for the program."""

    remappings: Mapping[str, str] = MappingProxyType({})
    """Names as written, unresolved."""
    params: Mapping[str, str] = MappingProxyType({})
    """Private parameters; values are YAML text."""
    name: str | None = None
    namespace: str | None = None
    log: str | None = None
    master_uri: str | None = None
    host: str | None = None
    """Value of `__ip` or `__hostname`."""
    rest: tuple[str, ...] = ()


def parse_arguments(arguments: Iterable[str]) -> Arguments:
    """Parse a command line; non-ROS arguments keep their order in `rest`.

    Unknown `__keys` are dropped, as roscpp and rospy do.
    """
    remappings: dict[str, str] = {}
    params: dict[str, str] = {}
    special: dict[str, str] = {}
    rest: list[str] = []
    for argument in arguments:
        match = _REMAP.fullmatch(argument)
        if match is None:
            rest.append(argument)
        elif match["from"].startswith("__"):
            special[match["from"]] = match["to"]
        elif match["from"].startswith("_"):
            params[match["from"][1:]] = match["to"]
        elif match["to"].strip():
            remappings[match["from"]] = match["to"].strip()
    return Arguments(
        remappings=remappings,
        params=params,
        name=special.get("__name"),
        namespace=special.get("__ns"),
        log=special.get("__log"),
        master_uri=special.get("__master"),
        host=special.get("__hostname", special.get("__ip")),
        rest=tuple(rest),
    )
