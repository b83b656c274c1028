"""Jobs of a launch file's nodes: processes, or stand-ins in this process."""

import contextlib
import shlex
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

import yaml

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.base.supervisor import Job, ProcessCommand, ProcessJob, ProcessTree, RespawnPolicy, TaskJob, Terminal
from trundle.base.yaml_loader import load_yaml
from trundle.gazebo.missing_nodes import find_launch_node, is_local, report_missing_node
from trundle.gazebo.nodes import (
    KEYBOARDS,
    ROSCPP,
    BuiltinReplacement,
    Executable,
    MissingNode,
    NodeHost,
    command_prefix,
    run_builtin_node,
    script_fault,
)
from trundle.robots.launch import LaunchNode
from trundle.robots.names import parse_arguments
from trundle.robots.packages import Packages
from trundle.ros import Loggers, Node
from trundle.ros.rospy.environment import with_finder

from ..graph import Graph
from .launch_prefix import read_prefix
from .logs import ros_home
from .terminals import NodeTerminals, TerminalOutput


@dataclass(frozen=True, slots=True, kw_only=True)
class LaunchedNode:
    """Node of a launch, and how it runs."""

    node: LaunchNode
    kind: Literal["process", "stand-in", "missing", "failed"]
    detail: str
    """Path of the program, package/type of the stand-in, or the reason why the node cannot run."""
    job: Job | None = None
    log_files: str = ""
    terminal: Terminal | None = None
    """Terminal on the page; None: the node has none."""

    def failed(self) -> "LaunchedNode":
        """Copy of this node, marked as not started."""
        return replace(self, kind="failed", job=None)


@dataclass(frozen=True, slots=True, kw_only=True)
class NodeStarter:
    """Makes the jobs of one launch."""

    graph: Graph
    packages: Packages
    env: Mapping[str, str]
    report: Diagnostics
    host: NodeHost
    """Interface of stand-ins to the launch."""
    terminals: NodeTerminals
    tree: ProcessTree
    """Tree of the started processes; ending the tree ends them."""
    log_folder: Path
    output: Literal["screen", "log"] | None = None
    """Output of the nodes; None: as in the launch file."""
    all_required: bool = False

    def prepare(
        self, node: LaunchNode, label: str, *, show: Callable[[str, str], None], extra_arguments: tuple[str, ...] = ()
    ) -> LaunchedNode:
        """Make a node's job; warn if no program or stand-in can run it.

        Args:
            node: node to run.
            label: the node's name in messages.
            show: called with the label and a line of output.
            extra_arguments: arguments of a program after those of the launch file.

        Raises:
            DescriptionError: a required node that nothing can run.
        """
        assert node.address is not None, "the caller has refused a node whose machine is unknown"
        if not is_local(node.address, self.env):
            reason = f"{node.address} is another machine, and nothing is started there; run trundle launch on it, too"
            return self._missing(node, f"{reason}, with ROS_MASTER_URI={self.graph.master_uri}")
        env = {**self.env, "ROS_NAMESPACE": node.namespace, "ROS_MASTER_URI": self.graph.master_uri, **dict(node.env)}
        if env["ROS_NAMESPACE"] == "/":
            del env["ROS_NAMESPACE"]
        match find_launch_node(node, self.packages, env):
            case Executable(path):
                return self._prepare_process(node, label, path, env, show=show, extra_arguments=extra_arguments)
            case BuiltinReplacement() as stand_in:
                return self._prepare_stand_in(node, label, stand_in)
            case MissingNode(reason):
                return self._missing(node, reason)

    def _prepare_process(
        self,
        node: LaunchNode,
        label: str,
        path: Path,
        env: Mapping[str, str],
        *,
        show: Callable[[str, str], None],
        extra_arguments: tuple[str, ...],
    ) -> LaunchedNode:
        if fault := script_fault(path):
            self.report.warn(node.at, f"node {node.full_name}: {path} {fault}", "node-program")
        prefix = read_prefix(_split(node.launch_prefix, node), env)
        output: Literal["screen", "log"] | TerminalOutput | None = None
        fault = prefix.fault
        if prefix.needs_terminal:
            output = self.terminals.find(node.full_name, is_process=True)
            if output is not None:
                fault = prefix.program_fault
            elif fault is not None:
                fault = f"{fault}, and {self.terminals.reason_for_none(node)}"
        if fault is not None:
            self._warn_of_prefix(node, f"is left out: {fault}")
        if output is None:
            output = self.output or ("screen" if node.launch_prefix and not prefix.words else node.output)
        command = self._command(
            node, label, path, env, (*prefix.words, *command_prefix(path, env)), extra_arguments, output
        )
        return LaunchedNode(
            node=node,
            kind="process",
            detail=f"{path}{_in_terminal(output)}",
            job=ProcessJob(command, show, tree=self.tree),
            log_files=f"{self.log_folder / label.replace('/', '-')}*.log",
            terminal=output if isinstance(output, Terminal) else None,
        )

    def _prepare_stand_in(self, node: LaunchNode, label: str, stand_in: BuiltinReplacement) -> LaunchedNode:
        terminal = None
        prefix = read_prefix(_split(node.launch_prefix, node), {})
        if prefix.needs_terminal and (node.package, node.type) in KEYBOARDS:
            terminal = self.terminals.find(node.full_name, is_process=False)
            if terminal is None:
                self._warn_of_prefix(node, f"is left out: {self.terminals.reason_for_none(node)}")
        elif node.launch_prefix:
            self._warn_of_prefix(node, "is not used; the stand-in runs within this process")
        page_terminal = terminal if isinstance(terminal, Terminal) else None
        name = label.replace("/", "-")
        log = None if (self.output or node.output) == "screen" else self.log_folder / f"{name}-stdout.log"
        return LaunchedNode(
            node=node,
            kind="stand-in",
            detail=f"{node.package}/{node.type}{_in_terminal(terminal)}",
            job=TaskJob(label, lambda: self._run(node, stand_in, log, page_terminal)),
            log_files="" if log is None else str(log),
            terminal=page_terminal,
        )

    def _warn_of_prefix(self, node: LaunchNode, problem: str) -> None:
        self.report.warn(
            node.at, f"node {node.full_name}: launch-prefix {node.launch_prefix!r} {problem}", "launch-prefix"
        )

    def _missing(self, node: LaunchNode, reason: str) -> LaunchedNode:
        report_missing_node(node, reason, self.report, is_required=self.policy(node).required)
        return LaunchedNode(node=node, kind="missing", detail=reason)

    def policy(self, node: LaunchNode) -> RespawnPolicy:
        """Respawn policy of a node."""
        required = node.required or self.all_required
        return RespawnPolicy(respawn=node.respawn, respawn_delay_s=node.respawn_delay_s, required=required)

    async def _run(
        self, node: LaunchNode, stand_in: BuiltinReplacement, log: Path | None, terminal: Terminal | None
    ) -> int:
        arguments = parse_arguments(_split(node.arguments, node))
        ros_node = Node(
            arguments.name or node.name,
            loop=self.graph.loop,
            master_uri=self.graph.master_uri,
            namespace=arguments.namespace or node.namespace,
            remappings={**dict(node.remappings), **arguments.remappings},
            params={name: _value(text) for name, text in arguments.params.items()},
            host=self.graph.host,
        )
        if (node.package, node.type) in ROSCPP:
            ros_node.log.loggers = Loggers.for_roscpp(node.package)
        with contextlib.ExitStack() as files:
            if log is not None:
                ros_node.log.quiet = files.enter_context(log.open("a", encoding="utf-8"))
            host = replace(self.host, env=dict(node.env), terminal=terminal, tree=self.tree)
            return await run_builtin_node(stand_in, ros_node, list(arguments.rest), host)

    def _command(
        self,
        node: LaunchNode,
        label: str,
        program: Path,
        env: Mapping[str, str],
        prefix: tuple[str, ...],
        extra_arguments: tuple[str, ...],
        output: Literal["screen", "log"] | TerminalOutput,
    ) -> ProcessCommand:
        """Return a program's command line, with its prefix."""
        log = self.log_folder / label.replace("/", "-")
        if isinstance(output, Terminal):
            env = {**env, "TERM": "xterm-256color", "COLORTERM": "truecolor"}
        return ProcessCommand(
            name=label,
            argv=(
                *prefix,
                str(program),
                *_split(node.arguments, node),
                *extra_arguments,
                *(f"{name}:={target}" for name, target in node.remappings),
                f"__name:={node.name}",
                f"__log:={log}.log",
            ),
            env=with_finder(env, self.packages.package_folders()),
            cwd=program.parent if node.cwd == "node" else ros_home(env),
            output=output,
            log_file=log.with_name(f"{log.name}-stdout.log"),
            reads_input=self.terminals.reads_keys,
        )


def _in_terminal(output: object) -> str:
    """Suffix of a node's row in the table, if its terminal is on the page."""
    return ", in a terminal on the page" if isinstance(output, Terminal) else ""


def _split(text: str, node: LaunchNode) -> list[str]:
    try:
        return shlex.split(text)
    except ValueError as error:
        raise DescriptionError(
            node.at, f"node {node.full_name}: {text!r} cannot be split into words: {error}", "launch-words"
        ) from None


def _value(text: str) -> object:
    """Value of a node's `_name:=value` argument: YAML if it is valid, else the text."""
    try:
        value = load_yaml(text)
    except yaml.YAMLError:
        return text
    return text if value is None else value
