"""Jobs of a launch file's nodes: processes, or stand-ins in this process."""

import contextlib
import os
import shlex
import shutil
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

import yaml

from trundle.diagnostics import DescriptionError, Diagnostics
from trundle.launch import LaunchNode
from trundle.names import parse_arguments
from trundle.nodes import (
    ROSCPP,
    BuiltinReplacement,
    Executable,
    MissingNode,
    NodeHost,
    run_builtin_node,
    script_fault,
    start_words,
)
from trundle.packages import Packages
from trundle.ros import Loggers, Node
from trundle.rospy.environment import with_finder
from trundle.supervisor import Job, ProcessCommand, ProcessJob, ProcessTree, RespawnPolicy, TaskJob
from trundle.yaml_loader import load_yaml

from ..graph import Graph
from ..missing_nodes import find_launch_node, is_here, report_missing_node
from .logs import ros_home

_TERMINALS = """
    gnome-terminal konsole lxterminal mate-terminal rxvt terminator uxterm x-terminal-emulator xfce4-terminal xterm
"""
"""Programs that open a window for a node."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Launched:
    """One node of a launch, and how it runs."""

    node: LaunchNode
    kind: Literal["process", "stand-in", "missing", "failed"]
    what: str
    """Path of the program, package/type of the stand-in, or why there is neither."""
    job: Job | None = None
    log_files: str = ""

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
        name = label.replace("/", "-")
        match find_launch_node(node, self.packages, env):
            case Executable(path):
                if fault := script_fault(path):
                    self.report.warn(node.at, f"node {node.full_name}: {path} {fault}")
                prefix = _split(node.launch_prefix, node)
                if prefix and (fault := _prefix_fault(prefix, env)):
                    what = f"launch-prefix {node.launch_prefix!r} is left out: {fault}"
                    self.report.warn(node.at, f"node {node.full_name}: {what}")
                    prefix = []
                job = ProcessJob(self._command(node, label, path, env, prefix, more), show, tree=self.tree)
                logs = f"{self.log_folder / name}*.log"
                return Launched(node=node, kind="process", what=str(path), job=job, log_files=logs)
            case BuiltinReplacement() as stand_in:
                if node.launch_prefix:
                    what = f"launch-prefix {node.launch_prefix!r} is not used; the stand-in runs within this process"
                    self.report.warn(node.at, f"node {node.full_name}: {what}")
                log = None if (self.output or node.output) == "screen" else self.log_folder / f"{name}-stdout.log"
                job = TaskJob(label, lambda: self._run(node, stand_in, log))
                logs = "" if log is None else str(log)
                return Launched(node=node, kind="stand-in", what=f"{node.package}/{node.type}", job=job, log_files=logs)
            case MissingNode(why):
                return self._missing(node, why)

    def _missing(self, node: LaunchNode, why: str) -> Launched:
        report_missing_node(node, why, self.report, is_required=self.policy(node).required)
        return Launched(node=node, kind="missing", what=why)

    def policy(self, node: LaunchNode) -> RespawnPolicy:
        """Respawn policy of a node."""
        required = node.required or self.all_required
        return RespawnPolicy(respawn=node.respawn, respawn_delay_s=node.respawn_delay_s, required=required)

    async def _run(self, node: LaunchNode, stand_in: BuiltinReplacement, log: Path | None) -> int:
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
            host = replace(self.host, env=dict(node.env), tree=self.tree)
            return await run_builtin_node(stand_in, ros_node, list(given.rest), host)

    def _command(
        self,
        node: LaunchNode,
        label: str,
        program: Path,
        env: Mapping[str, str],
        prefix: list[str],
        more: tuple[str, ...],
    ) -> ProcessCommand:
        log = self.log_folder / label.replace("/", "-")
        return ProcessCommand(
            name=label,
            argv=(
                *prefix,
                *start_words(program, env),
                str(program),
                *_split(node.arguments, node),
                *more,
                *(f"{there}:={here}" for there, here in node.remappings),
                f"__name:={node.name}",
                f"__log:={log}.log",
            ),
            env=with_finder(env, self.packages.package_folders()),
            cwd=program.parent if node.cwd == "node" else ros_home(env),
            output=self.output or ("screen" if node.launch_prefix and not prefix else node.output),
            log_file=log.with_name(f"{log.name}-stdout.log"),
        )


def _prefix_fault(prefix: list[str], env: Mapping[str, str]) -> str | None:
    """Return why a launch-prefix cannot start a node here; None: it can."""
    program = Path(prefix[0]).name
    if shutil.which(prefix[0], path=env.get("PATH", os.defpath)) is None:
        return f"there is no {program} here"
    if program in _TERMINALS.split() and not (env.get("DISPLAY") or env.get("WAYLAND_DISPLAY")):
        return f"{program} needs a display; keys reach a node that is started by itself, with rosrun"
    return None


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
