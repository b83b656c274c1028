"""Helpers of old tools."""

import rosgraph
from rosgraph.names import script_resolve_name as script_resolve_name


def get_master() -> rosgraph.Master:
    """Client of the master."""
    return rosgraph.Master("/script")


def get_param_server() -> rosgraph.Master:
    """Client of the parameter server."""
    return get_master()


def myargv(argv: list[str] | None = None) -> list[str]:
    """Arguments without remappings."""
    return rosgraph.myargv(argv)
