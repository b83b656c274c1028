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
from trundle.gazebo.missing_nodes import find_launch_node, is_here, report_missing_node
from trundle.gazebo.nodes import (
    KEYBOARDS,
    ROSCPP,
    BuiltinReplacement,
    Executable,
    MissingNode,
    NodeHost,
    run_builtin_node,
    script_fault,
    start_words,
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
class Launched:
    """One node of a launch, and how it runs."""

    node: LaunchNode
    kind: Literal["process", "stand-in", "missing", "failed"]
    what: str
    """Path of the program, package/type of the stand-in, or why there is neither."""
    job: Job | None = None
    log_files: str = ""
    terminal: Terminal | None = None
    """Terminal of ours that it has; None: it has none of its own."""

    def failed(self) -> "Launched":
        """Copy of this, marked as not started."""
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
    """Parent of the started processes; they end with it."""
    log_folder: Path
    output: Literal["screen", "log"] | None = None
    """Overrides what the launch file says."""
    all_required: bool = False

    def prepare(
        self, node: LaunchNode, label: str, *, show: Callable[[str, str], None], more: tuple[str, ...] = ()
    ) -> Launched:
        """Make a node's job; warn if nothing can run it.

        Args:
            node: the one to run.
            label: its name in messages.
            show: takes the label and a line of output.
            more: further arguments of a program, after those of the launch file.

        Raises:
            DescriptionError: nothing can run it, and it is required.
        """
        assert node.address is not None, "a launch with a node of no machine is refused"
        if not is_here(node.address, self.env):
            why = f"{node.address} is another machine, and nothing is started there; run trundle launch on it, too"
            return self._missing(node, f"{why}, with ROS_MASTER_URI={self.graph.master_uri}")
        env = {**self.env, "ROS_NAMESPACE": node.namespace, "ROS_MASTER_URI": self.graph.master_uri, **dict(node.env)}
        if env["ROS_NAMESPACE"] == "/":
            del env["ROS_NAMESPACE"]
        match find_launch_node(node, self.packages, env):
            case Executable(path):
                return self._prepare_process(node, label, path, env, show=show, more=more)
            case BuiltinReplacement() as stand_in:
                return self._prepare_stand_in(node, label, stand_in)
            case MissingNode(why):
                return self._missing(node, why)

    def _prepare_process(
        self,
        node: LaunchNode,
        label: str,
        path: Path,
        env: Mapping[str, str],
        *,
        show: Callable[[str, str], None],
        more: tuple[str, ...],
    ) -> Launched:
        if fault := script_fault(path):
            self.report.warn(node.at, f"node {node.full_name}: {path} {fault}")
        prefix = read_prefix(_split(node.launch_prefix, node), env)
        output: Literal["screen", "log"] | TerminalOutput | None = None
        fault = prefix.fault
        if prefix.wants_terminal:
            output = self.terminals.find(node.full_name, is_process=True)
            if output is not None:
                fault = prefix.program_fault
            elif fault is not None:
                fault = f"{fault}, and {self.terminals.why_none(node)}"
        if fault is not None:
            self._warn_of_prefix(node, f"is left out: {fault}")
        if output is None:
            output = self.output or ("screen" if node.launch_prefix and not prefix.words else node.output)
        command = self._command(node, label, path, env, (*prefix.words, *start_words(path, env)), more, output)
        return Launched(
            node=node,
            kind="process",
            what=f"{path}{_in_terminal(output)}",
            job=ProcessJob(command, show, tree=self.tree),
            log_files=f"{self.log_folder / label.replace('/', '-')}*.log",
            terminal=output if isinstance(output, Terminal) else None,
        )

    def _prepare_stand_in(self, node: LaunchNode, label: str, stand_in: BuiltinReplacement) -> Launched:
        terminal = None
        prefix = read_prefix(_split(node.launch_prefix, node), {})
        if prefix.wants_terminal and (node.package, node.type) in KEYBOARDS:
            terminal = self.terminals.find(node.full_name, is_process=False)
            if terminal is None:
                self._warn_of_prefix(node, f"is left out: {self.terminals.why_none(node)}")
        elif node.launch_prefix:
            self._warn_of_prefix(node, "is not used; the stand-in runs within this process")
        own = terminal if isinstance(terminal, Terminal) else None
        name = label.replace("/", "-")
        log = None if (self.output or node.output) == "screen" else self.log_folder / f"{name}-stdout.log"
        return Launched(
            node=node,
            kind="stand-in",
            what=f"{node.package}/{node.type}{_in_terminal(terminal)}",
            job=TaskJob(label, lambda: self._run(node, stand_in, log, own)),
            log_files="" if log is None else str(log),
            terminal=own,
        )

    def _warn_of_prefix(self, node: LaunchNode, what: str) -> None:
        self.report.warn(node.at, f"node {node.full_name}: launch-prefix {node.launch_prefix!r} {what}")

    def _missing(self, node: LaunchNode, why: str) -> Launched:
        report_missing_node(node, why, self.report, is_required=self.policy(node).required)
        return Launched(node=node, kind="missing", what=why)

    def policy(self, node: LaunchNode) -> RespawnPolicy:
        """Respawn policy of a node."""
        required = node.required or self.all_required
        return RespawnPolicy(respawn=node.respawn, respawn_delay_s=node.respawn_delay_s, required=required)

    async def _run(
        self, node: LaunchNode, stand_in: BuiltinReplacement, log: Path | None, terminal: Terminal | None
    ) -> int:
        given = parse_arguments(_split(node.arguments, node))
        ros_node = Node(
            given.name or node.name,
            loop=self.graph.loop,
            master_uri=self.graph.master_uri,
            namespace=given.namespace or node.namespace,
            remappings={**dict(node.remappings), **given.remappings},
            params={name: _value(text) for name, text in given.params.items()},
            host=self.graph.host,
        )
        if (node.package, node.type) in ROSCPP:
            ros_node.log.loggers = Loggers.for_roscpp(node.package)
        with contextlib.ExitStack() as files:
            if log is not None:
                ros_node.log.quiet = files.enter_context(log.open("a", encoding="utf-8"))
            host = replace(self.host, env=dict(node.env), terminal=terminal, tree=self.tree)
            return await run_builtin_node(stand_in, ros_node, list(given.rest), host)

    def _command(
        self,
        node: LaunchNode,
        label: str,
        program: Path,
        env: Mapping[str, str],
        before: tuple[str, ...],
        more: tuple[str, ...],
        output: Literal["screen", "log"] | TerminalOutput,
    ) -> ProcessCommand:
        """Return the command line of a program, with the words before it."""
        log = self.log_folder / label.replace("/", "-")
        if isinstance(output, Terminal):
            env = {**env, "TERM": "xterm-256color", "COLORTERM": "truecolor"}
        return ProcessCommand(
            name=label,
            argv=(
                *before,
                str(program),
                *_split(node.arguments, node),
                *more,
                *(f"{there}:={here}" for there, here in node.remappings),
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
    """Return where the terminal of a node is, for the table of what runs."""
    return ", in a terminal on the page" if isinstance(output, Terminal) else ""


def _split(text: str, node: LaunchNode) -> list[str]:
    try:
        return shlex.split(text)
    except ValueError as error:
        raise DescriptionError(
            node.at, f"node {node.full_name}: {text!r} cannot be split into words: {error}"
        ) from None


def _value(text: str) -> object:
    """Value of a node's `_name:=value` argument: as YAML, else the text."""
    try:
        value = load_yaml(text)
    except yaml.YAMLError:
        return text
    return text if value is None else value
