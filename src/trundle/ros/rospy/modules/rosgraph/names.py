"""Names of the graph: legality, joining, resolution, remapping arguments."""

import os
import re
import sys
from collections.abc import Mapping, Sequence
from typing import Any

from .rosenv import ROS_NAMESPACE

MSG_EXT = ".msg"
SRV_EXT = ".srv"
SEP = GLOBALNS = "/"
PRIV_NAME = "~"
REMAP = ":="
ANYTYPE = "*"

NAME_LEGAL_CHARS_P = re.compile(r"^[\~\/A-Za-z][\w\/]*$")
BASE_NAME_LEGAL_CHARS_P = re.compile(r"^[A-Za-z][\w]*$")
REMAP_PATTERN = re.compile(r"^([\~\/A-Za-z]|_|__)[\w\/]*:=.*")


def get_ros_namespace(env: Mapping[str, str] | None = None, argv: Sequence[str] | None = None) -> str:
    """Namespace of this program, with slashes around it: `__ns:=` on the command line, else ROS_NAMESPACE."""
    for argument in sys.argv if argv is None else argv:
        if argument.startswith("__ns:="):
            return make_global_ns(argument.removeprefix("__ns:="))
    return make_global_ns((os.environ if env is None else env).get(ROS_NAMESPACE) or GLOBALNS)


def make_caller_id(name: str) -> str:
    """Global name of a node, with trailing slash."""
    return make_global_ns(ns_join(get_ros_namespace(), name))


def make_global_ns(name: str) -> str:
    """Namespace with slashes around it.

    Raises:
        ValueError: a private name.
    """
    if is_private(name):
        raise ValueError(f"cannot turn [{name}] into a global name")
    name = name if is_global(name) else SEP + name
    return name if name.endswith(SEP) else name + SEP


def is_global(name: str) -> bool:
    """True for `/name`; '' and None are returned unchanged."""
    return name and name[0] == SEP  # pyright: ignore[reportReturnType]


def is_private(name: str) -> bool:
    """True for `~name`; '' and None are returned unchanged."""
    return name and name[0] == PRIV_NAME  # pyright: ignore[reportReturnType]


def namespace(name: Any) -> str:
    """Namespace of a name, with trailing slash.

    Raises:
        ValueError: None.
        TypeError: not a text.
    """
    if name is None:
        raise ValueError("name")
    if not isinstance(name, str):
        raise TypeError("name")
    name = name.removesuffix(SEP)
    return name[: name.rfind(SEP) + 1] or SEP


def ns_join(ns: str, name: str) -> str:
    """Prepend a namespace; private and global names stay unchanged."""
    if is_private(name) or is_global(name):
        return name
    if ns == PRIV_NAME:
        return PRIV_NAME + name
    if not ns:
        return name
    return ns + name if ns.endswith(SEP) else ns + SEP + name


def load_mappings(argv: Sequence[str]) -> dict[str, str]:
    """Remappings on a command line; private parameters (`_name:=value`) are skipped."""
    mappings: dict[str, str] = {}
    for argument in argv:
        if not is_legal_remap(argument):
            continue
        parts = [part.strip() for part in argument.split(REMAP)]
        if len(parts) != 2:
            sys.stderr.write(f"ERROR: Invalid remapping argument '{argument}'\n")
        elif parts[0] and parts[1] and not (len(parts[0]) > 1 and parts[0][0] == "_" != parts[0][1]):
            mappings[parts[0]] = parts[1]
    return mappings


def is_legal_name(name: str | None) -> bool:
    """True if a name of the graph is legal; '' is."""
    if not name:
        return name is not None
    match = NAME_LEGAL_CHARS_P.match(name)
    return match is not None and match.group(0) == name and "//" not in name


def is_legal_base_name(name: str | None) -> bool:
    """True if a name without namespace is legal."""
    match = None if name is None else BASE_NAME_LEGAL_CHARS_P.match(name)
    return match is not None and match.group(0) == name


def is_legal_remap(arg: str | None) -> bool:
    """True for `from:=to`."""
    match = None if arg is None else REMAP_PATTERN.match(arg)
    return match is not None and match.group(0) == arg


def canonicalize_name(name: str) -> str:
    """Remove doubled and trailing slashes."""
    if not name or name == SEP:
        return name
    joined = SEP.join(part for part in name.split(SEP) if part)
    return SEP + joined if name[0] == SEP else joined


def resolve_name(name: str, namespace_: str, remappings: Mapping[str, str] | None = None) -> str:
    """Resolve a name to a global one.

    Args:
        name: relative, private or global name; '' is the parent of `namespace_`.
        namespace_: node's name.
        remappings: global name → global name.
    """
    if not name:
        return namespace(namespace_)
    name = canonicalize_name(name)
    if is_global(name):
        resolved = name
    elif is_private(name):
        resolved = canonicalize_name(namespace_ + SEP + name[1:])
    else:
        resolved = namespace(namespace_) + name
    return (remappings or {}).get(resolved, resolved)


def script_resolve_name(script_name: str, name: str) -> str:
    """Resolve a name for a tool that is not a node."""
    if not name:
        return get_ros_namespace()
    if is_global(name):
        return name
    if is_private(name):
        return ns_join(make_caller_id(script_name), name[1:])
    return get_ros_namespace() + name


def anonymous_name(id: str) -> str:
    """Make a unique name of a node."""
    import random
    import socket

    name = f"{id}_{socket.gethostname()}_{os.getpid()}_{random.randint(0, sys.maxsize)}"
    return re.sub(r"[.:-]", "_", name)
