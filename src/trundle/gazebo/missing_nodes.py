"""Nodes of a launch that nothing can run."""

import shlex
import socket
from collections.abc import Iterable, Mapping

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.gazebo.nodes import BuiltinReplacement, Executable, MissingNode, find_node
from trundle.robots.launch import LaunchNode
from trundle.robots.packages import Packages


def report_missing_nodes(
    nodes: Iterable[LaunchNode], packages: Packages, env: Mapping[str, str], report: Diagnostics
) -> None:
    """Report the nodes that a launch would not find; those of other machines are not searched."""
    for node in nodes:
        if node.address is None or not is_here(node.address, env):
            continue
        found = find_launch_node(node, packages, {**env, **dict(node.env)})
        if isinstance(found, MissingNode):
            try:
                report_missing_node(node, found.why, report, is_required=node.required)
            except DescriptionError as error:
                report.error(error)


def find_launch_node(
    node: LaunchNode, packages: Packages, env: Mapping[str, str]
) -> Executable | BuiltinReplacement | MissingNode:
    """Find a node of a launch; advice to run it elsewhere gives it its name, arguments and remappings."""
    namespace = () if node.namespace == "/" else (f"__ns:={node.namespace}",)
    remappings = (f"{there}:={here}" for there, here in node.remappings)
    words = (*_split(node.arguments), *remappings, f"__name:={node.name}", *namespace)
    return find_node(node.package, node.type, packages.find_package, env=env, arguments=node.arguments, words=words)


def _split(arguments: str) -> list[str]:
    try:
        return shlex.split(arguments)
    except ValueError:  # an open quote, which is reported when the node is started
        return arguments.split()


def report_missing_node(node: LaunchNode, why: str, report: Diagnostics, *, is_required: bool) -> None:
    """Warn that the launch goes on without a node.

    Raises:
        DescriptionError: the launch requires it.
    """
    what = f"node {node.full_name}: {why}"
    if is_required:
        raise DescriptionError(node.at, f"{what}; the launch requires it")
    report.warn(node.at, f"{what}; the launch goes on without it")


def is_here(address: str, env: Mapping[str, str]) -> bool:
    """Return True if a <machine>'s address is this machine, by any of its names."""
    names = {"", "localhost", "::1", socket.gethostname(), env.get("ROS_HOSTNAME"), env.get("ROS_IP")}
    return address in names or address.startswith("127.")
