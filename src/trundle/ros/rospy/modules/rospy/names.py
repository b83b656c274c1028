"""Names of this node: remappings and resolution."""

import sys
from collections.abc import Mapping, Sequence
from typing import Any

import rosgraph.names
from rosgraph.names import (
    ANYTYPE,
    REMAP,
    SEP,
    canonicalize_name,
    get_ros_namespace,
    is_global,
    is_private,
    load_mappings,
    make_global_ns,
    namespace,
    ns_join,
)

from .exceptions import ROSException, ROSInitException
from .impl.validators import Check, ParameterInvalid, checked_text

__all__ = [
    "ANYTYPE", "REMAP", "SEP", "SERVICE_ANYTYPE", "TOPIC_ANYTYPE", "canonicalize_name", "get_caller_id",
    "get_mappings", "get_name", "get_namespace", "get_resolved_mappings", "get_ros_namespace", "global_name",
    "initialize_mappings", "is_global", "is_private", "load_mappings", "make_global_ns", "namespace", "ns_join",
    "reload_mappings", "remap_name", "resolve_name", "resolve_name_without_node_name", "scoped_name", "valid_name",
]  # fmt: skip

TOPIC_ANYTYPE = SERVICE_ANYTYPE = ANYTYPE

_mappings: dict[str, str] = load_mappings(sys.argv)
_resolved_mappings: dict[str, str] = {}
_caller_namespace = get_ros_namespace()
_caller_id = f"{_caller_namespace}unnamed"


def reload_mappings(argv: Sequence[str]) -> None:
    """Read the remappings of a command line."""
    global _mappings
    _mappings = load_mappings(argv)


def initialize_mappings(node_name: str) -> None:
    """Resolve the remappings for a node."""
    global _resolved_mappings
    _resolved_mappings = {
        old if old.startswith("__") else rosgraph.names.resolve_name(old, node_name): (
            new if old.startswith("__") else rosgraph.names.resolve_name(new, node_name)
        )
        for old, new in _mappings.items()
    }


def resolve_name_without_node_name(name: str) -> str:
    """Resolve a topic's or service's name before the node has one.

    Raises:
        ValueError: a private name.
    """
    if is_private(name):
        raise ValueError("~name topics cannot be created before init_node() has been called")
    node = ns_join(get_namespace(), "node")
    resolved = rosgraph.names.resolve_name(name, node)
    for old, new in _mappings.items():
        if not old.startswith("__") and rosgraph.names.resolve_name(old, node) == resolved:
            if is_private(new):
                raise ROSInitException(
                    f"due to the way this node is written, {name} cannot be remapped to a ~name. \n"
                    "The declaration of topics/services must be moved after the call to init_node()"
                )
            return rosgraph.names.resolve_name(new, node)
    return resolved


def get_mappings() -> Mapping[str, str]:
    """Remappings as written."""
    return _mappings


def get_resolved_mappings() -> Mapping[str, str]:
    """Remappings of global names."""
    return _resolved_mappings


def resolve_name(name: str, caller_id: str | None = None) -> str:
    """Resolve and remap a name."""
    node = caller_id or get_name()
    if not name:
        return namespace(node)
    name = canonicalize_name(str(name))
    if is_global(name):
        resolved = name
    elif is_private(name):
        resolved = ns_join(node, name[1:])
    else:
        resolved = namespace(node) + name
    return _resolved_mappings.get(resolved, resolved)


def remap_name(name: str, caller_id: str | None = None, resolved: bool = True) -> str:
    """Remap a name; a name without remapping stays unchanged."""
    del resolved
    node = caller_id or get_caller_id()
    return rosgraph.names.resolve_name(_mappings[name], node) if name in _mappings else name


def scoped_name(caller_id: str, name: str) -> str:
    """Name relative to a node's namespace.

    Raises:
        ROSException: the node's name is not global.
    """
    if not is_global(caller_id):
        raise ROSException("caller_id must be global")
    return canonicalize_name(name)[len(namespace(caller_id)) :]


def get_namespace() -> str:
    """Namespace of this node, with slashes around it."""
    return _caller_namespace


def get_name() -> str:
    """Global name of this node."""
    return _caller_id


get_caller_id = get_name


def _set_caller_id(caller_id: str) -> None:  # pyright: ignore[reportUnusedFunction]
    """Set this node's name."""
    global _caller_id, _caller_namespace
    _caller_id = caller_id
    _caller_namespace = namespace(caller_id)


def valid_name(param_name: str, resolve: bool = True) -> Check:
    """Check that a parameter is a name, resolved in the caller's namespace unless `resolve` is false."""

    def check(value: Any, caller_id: str) -> str:
        name = checked_text(param_name, value)
        if ":" in name or " " in name:
            raise ParameterInvalid(f"ERROR: parameter [{param_name}] contains illegal chars")
        return rosgraph.names.resolve_name(name, caller_id) if resolve else name

    return check


def global_name(param_name: str) -> Check:
    """Check that a parameter is a global name."""

    def check(value: Any, caller_id: str) -> str:
        del caller_id
        if not is_global(checked_text(param_name, value)):
            raise ParameterInvalid(f"ERROR: parameter [{param_name}] must be a globally referenced name")
        return value

    return check
