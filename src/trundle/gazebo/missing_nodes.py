"""Nodes of a launch that cannot be found."""

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
    """Report the nodes that a launch would not find on this machine; nodes for other machines are skipped."""
    for node in nodes:
        if node.address is None or not is_local(node.address, env):
            continue
        node_program = find_launch_node(node, packages, {**env, **dict(node.env)})
        if isinstance(node_program, MissingNode):
            try:
                report_missing_node(node, node_program.reason, report, is_required=node.required)
            except DescriptionError as error:
                report.error(error)


def find_launch_node(
    node: LaunchNode, packages: Packages, env: Mapping[str, str]
) -> Executable | BuiltinReplacement | MissingNode:
    """Find a node of a launch; advice on running it elsewhere includes its name, arguments and remappings."""
    namespace = () if node.namespace == "/" else (f"__ns:={node.namespace}",)
    remappings = (f"{source}:={target}" for source, target in node.remappings)
    command_line = (*_split(node.arguments), *remappings, f"__name:={node.name}", *namespace)
    return find_node(
        node.package, node.type, packages.find_package, env=env, arguments=node.arguments, command_line=command_line
    )


def _split(arguments: str) -> list[str]:
    try:
        return shlex.split(arguments)
    except ValueError:  # a quote is not closed, which is reported when the node starts
        return arguments.split()


def report_missing_node(node: LaunchNode, why: str, report: Diagnostics, *, is_required: bool) -> None:
    """Warn that the launch goes on without a node.

    Raises:
        DescriptionError: the launch requires it.
    """
    message = f"node {node.full_name}: {why}"
    if is_required:
        raise DescriptionError(node.at, f"{message}; the launch requires it", "missing-node")
    report.warn(node.at, f"{message}; the launch goes on without it", "missing-node")


def is_local(address: str, env: Mapping[str, str]) -> bool:
    """Return True if a <machine>'s address is this machine, by any of its names."""
    names = {"", "localhost", "::1", socket.gethostname(), env.get("ROS_HOSTNAME"), env.get("ROS_IP")}
    return address in names or address.startswith("127.")
