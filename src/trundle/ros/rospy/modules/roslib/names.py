"""Names of the graph, and of resources in packages."""

import re

from rosgraph.names import (
    PRIV_NAME as PRIV_NAME,
    REMAP as REMAP,
    SEP as SEP,
    anonymous_name as anonymous_name,
    canonicalize_name as canonicalize_name,
    get_ros_namespace as get_ros_namespace,
    is_global as is_global,
    is_legal_base_name as is_legal_base_name,
    is_legal_name as is_legal_name,
    is_private as is_private,
    load_mappings as load_mappings,
    make_caller_id as make_caller_id,
    make_global_ns as make_global_ns,
    namespace as namespace,
    ns_join as ns_join,
    resolve_name as resolve_name,
)

PRN_SEPARATOR = "/"
TYPE_SEPARATOR = "/"
MSG_EXT = ".msg"
SRV_EXT = ".srv"
_LEGAL_RESOURCE = re.compile(r"^[A-Za-z][\w_\/]*$")


def resource_name(res_pkg_name: str, name: str, my_pkg: str | None = None) -> str:
    """Name of a resource with its package, unless the package is `my_pkg`."""
    return f"{res_pkg_name}/{name}" if res_pkg_name and res_pkg_name != my_pkg else name


def resource_name_base(name: str) -> str:
    """Name without package."""
    return name[name.rfind(PRN_SEPARATOR) + 1 :]


def resource_name_package(name: str) -> str | None:
    """Package of a resource's name; None if it has none."""
    return name.partition(PRN_SEPARATOR)[0] if PRN_SEPARATOR in name else None


def package_resource_name(name: str) -> tuple[str, str]:
    """Package and name of a resource; '' for no package.

    Raises:
        ValueError: more than one slash.
    """
    if name.count(PRN_SEPARATOR) > 1:
        raise ValueError(f"invalid name [{name}]")
    package, slash, base = name.rpartition(PRN_SEPARATOR)
    return (package, base) if slash else ("", name)


def is_legal_resource_name(name: str) -> bool:
    """True if a resource's name is legal."""
    return _LEGAL_RESOURCE.match(name) is not None and "//" not in name


def is_legal_resource_base_name(name: str) -> bool:
    """True if a resource's name without package is legal."""
    return is_legal_base_name(name)
