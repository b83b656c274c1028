"""Legality and resolution of ROS names."""

import re
from collections.abc import Mapping

_LEGAL = re.compile(r"[~/A-Za-z][A-Za-z0-9_/]*")
_LEGAL_BASE = re.compile(r"[A-Za-z][A-Za-z0-9_]*")


def is_legal_name(name: str) -> bool:
    """True if a graph name is legal, including '', the name of the namespace."""
    return not name or (_LEGAL.fullmatch(name) is not None and "//" not in name)


def is_legal_base_name(name: str) -> bool:
    """True if a name without namespace, such as a node's, is legal."""
    return _LEGAL_BASE.fullmatch(name) is not None


def canonical_name(name: str) -> str:
    """Remove doubled and trailing slashes; keep a leading one."""
    parts = "/".join(part for part in name.split("/") if part)
    return "/" + parts if name.startswith("/") else parts


def join_names(namespace: str, name: str) -> str:
    """Prepend a namespace; global and private names stay unchanged."""
    if name.startswith(("/", "~")) or not namespace:
        return name
    return namespace + name if namespace.endswith("/") else f"{namespace}/{name}"


def parent_namespace(name: str) -> str:
    """Namespace of a name, with trailing slash: '/a/' for '/a/b'."""
    return name.rstrip("/").rpartition("/")[0] + "/"


def resolve_name(name: str, node: str, remappings: Mapping[str, str] | None = None) -> str:
    """Resolve a name to a global name.

    Args:
        name: '/global', '~private', 'relative', or '' for the node's namespace.
        node: full name of the node, such as '/robot/driver'.
        remappings: global name → global name, applied last.
    """
    if not name:
        return parent_namespace(node)
    if name.startswith("~"):
        resolved = canonical_name(f"{node}/{name[1:]}")
    elif name.startswith("/"):
        resolved = canonical_name(name)
    else:
        resolved = canonical_name(parent_namespace(node) + name)
    return (remappings or {}).get(resolved, resolved)
