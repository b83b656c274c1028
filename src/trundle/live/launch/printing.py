"""Output of `trundle launch --nodes` and the like, line for line as roslaunch prints it."""

import shlex
from collections.abc import Mapping, Sequence
from pathlib import Path

import yaml

from trundle.base.diagnostics import UsageError
from trundle.robots.launch import LaunchArgument, LaunchNode, LaunchParam, LaunchPlan
from trundle.robots.packages import Packages

_MAX_VALUE_LENGTH = 20
_RULE = "========"


def node_names(plan: LaunchPlan) -> str:
    """`--nodes`: every node, then every test."""
    return "\n".join(node.full_name for node in _nodes(plan))


def file_names(plan: LaunchPlan) -> str:
    """`--files`: every launch file read."""
    return "\n".join(str(file.absolute()) for file in plan.files)


def node_file(plan: LaunchPlan, name: str) -> str:
    """`--find-node`: the launch file that declares a node.

    Raises:
        UsageError: no such node.
    """
    return _named(plan, name).at.file


def node_command(plan: LaunchPlan, name: str, packages: Packages, env: Mapping[str, str]) -> str:
    """`--args`: the command line of a node, with the environment variables that the launch adds.

    Raises:
        UsageError: no such node, or nothing can run it.
    """
    node = _named(plan, name)
    variables = [] if node.namespace == "/" else [("ROS_NAMESPACE", node.namespace)]
    variables += [(key, value) for key, value in node.env if env.get(key) != value]
    from trundle.gazebo.nodes import BuiltinReplacement, Executable, MissingNode, find_node

    match find_node(node.package, node.type, packages.find_package, env=env):
        case Executable(path):
            program = str(path)
        case BuiltinReplacement():
            program = f"{node.package}/{node.type}"  # a stand-in runs in this process: there is no command line to copy
        case MissingNode(reason):
            raise UsageError(f"node {node.full_name}: {reason}")
    words = [*shlex.split(node.launch_prefix), program, *shlex.split(node.arguments)]
    words += [f"{name}:={target}" for name, target in node.remappings]
    return " ".join([*(f'{key}="{value}"' for key, value in variables), *words, f"__name:={node.name}"])


def translations(plan: LaunchPlan, packages: Packages, env: Mapping[str, str]) -> str:
    """`--show-translation`: changes to the nodes' Python 2 programs."""
    from trundle.gazebo.nodes import Executable, find_node
    from trundle.ros.rospy.python2.cache import changes

    programs: dict[Path, None] = {}
    for node in _nodes(plan):
        executable = find_node(node.package, node.type, packages.find_package, env=env, arguments=node.arguments)
        if isinstance(executable, Executable):
            programs[executable.path] = None
    texts = [text for program in programs if (text := changes(program))]
    return "\n".join(texts) or "no node of this launch is a Python 2 program"


def parameters(params: Sequence[LaunchParam]) -> str:
    """`--dump-params`: YAML, and the empty line that roslaunch ends it with."""
    return yaml.safe_dump({param.name: param.value for param in params})


def arguments(declared: Sequence[LaunchArgument]) -> str:
    """`--ros-args`; an argument whose default is empty counts as required, as in roslaunch."""
    settable = sorted((a for a in declared if a.required or a.default is not None), key=lambda a: a.name)
    required = [f"  {a.name}: {a.doc or 'undocumented'}" for a in settable if not a.default]
    optional = [f'  {a.name} (default "{a.default}"): {a.doc or "undocumented"}' for a in settable if a.default]
    lines = ["Required Arguments:", *required] if required else []
    lines += ["Optional Arguments:", *optional] if optional else []
    return "\n".join(lines) or "No arguments."


def summary(plan: LaunchPlan, params: Mapping[str, object]) -> str:
    """roslaunch's summary before it starts nodes: shortened parameters, and nodes by namespace."""
    lines = ["", "SUMMARY", _RULE]
    if plan.clear_params:
        lines += ["", "CLEAR PARAMETERS", *sorted(f" * {name.rstrip('/')}/" for name in plan.clear_params)]
    if params:
        lines += ["", "PARAMETERS", *sorted(f" * {name}: {_short(value)}" for name, value in params.items())]
    lines += ["", "NODES"]
    for namespace in sorted({node.namespace.rstrip("/") + "/" for node in plan.nodes}):
        nodes = [n for n in plan.nodes if n.namespace.rstrip("/") + "/" == namespace]
        lines += [f"  {namespace}", *sorted(f"    {n.name} ({n.package}/{n.type})" for n in nodes)]
    return "\n".join([*lines, ""])


def _short(value: object) -> str:
    text = str(value)
    if len(text) > _MAX_VALUE_LENGTH:
        text = text[: _MAX_VALUE_LENGTH - 3] + "..."
    text = text.rstrip()
    return text if all(" " <= char <= "~" for char in text) else "<...>"


def _nodes(plan: LaunchPlan) -> list[LaunchNode]:
    return [*plan.nodes, *(test.node for test in plan.tests)]


def _named(plan: LaunchPlan, name: str) -> LaunchNode:
    full = "/" + name.lstrip("/")
    for node in _nodes(plan):
        if node.full_name == full:
            return node
    names = ", ".join(node.full_name for node in _nodes(plan)) or "none"
    raise UsageError(f"no node named {full}; nodes of this launch: {names}")
