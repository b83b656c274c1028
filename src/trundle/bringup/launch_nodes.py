"""Turns a launch file's nodes into jobs: processes, or stand-ins that run here."""

import shlex
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import yaml

from trundle.diagnostics import DescriptionError, Diagnostics
from trundle.launch import LaunchNode
from trundle.names import parse_arguments
from trundle.nodes import Executable, Host, Missing, Replacement, find_node, run_stand_in
from trundle.packages import Packages
from trundle.ros import Node
from trundle.supervisor import Command, Job, Policy, ProcessJob, TaskJob

from .graph import Graph


@dataclass(frozen=True, slots=True, kw_only=True)
class NodeStarter:
    """Makes the jobs of one launch."""

    graph: Graph
    packages: Packages
    env: Mapping[str, str]
    report: Diagnostics
    host: Host
    """What stand-ins may use."""
    log_folder: Path

    def job(self, node: LaunchNode, *, screen: bool, show: Callable[[str, str], None]) -> Job | None:
        """The job that runs a node; None, after a warning, where nothing can.

        Raises:
            DescriptionError: nothing can run it, and the launch requires it.
        """
        env = {**self.env, **dict(node.env), "ROS_MASTER_URI": self.graph.master_uri, "ROS_NAMESPACE": node.namespace}
        match find_node(node.package, node.type, self.packages.find_package, env=env):
            case Executable(path):
                return ProcessJob(self._command(node, path, env, screen=screen), show)
            case Replacement() as stand_in:
                return TaskJob(node.full_name, lambda: self._run(node, stand_in))
            case Missing(why):
                what = f"node {node.full_name}: {why}"
                if node.required:
                    raise DescriptionError(node.at, f"{what}; the launch requires it")
                self.report.warn(node.at, f"{what}; the launch goes on without it")
                return None

    def policy(self, node: LaunchNode) -> Policy:
        """What the node's end means."""
        return Policy(respawn=node.respawn, respawn_delay_s=node.respawn_delay_s, required=node.required)

    async def _run(self, node: LaunchNode, stand_in: Replacement) -> int:
        given = parse_arguments(shlex.split(node.arguments))
        ros_node = Node(
            given.name or node.name,
            loop=self.graph.loop,
            master_uri=self.graph.master_uri,
            namespace=given.namespace or node.namespace,
            remappings={**dict(node.remappings), **given.remappings},
            params={name: _value(text) for name, text in given.params.items()},
            host=self.graph.host,
        )
        return await run_stand_in(stand_in, ros_node, list(given.rest), self.host)

    def _command(self, node: LaunchNode, program: Path, env: Mapping[str, str], *, screen: bool) -> Command:
        log = self.log_folder / f"{node.full_name.strip('/').replace('/', '-')}.log"
        self.log_folder.mkdir(parents=True, exist_ok=True)
        return Command(
            name=node.full_name,
            argv=(
                *shlex.split(node.launch_prefix),
                str(program),
                *shlex.split(node.arguments),
                *(f"{there}:={here}" for there, here in node.remappings),
                f"__name:={node.name}",
                f"__log:={log}",
            ),
            env=env,
            cwd=program.parent if node.cwd == "node" else Path(env.get("ROS_HOME", Path.home() / ".ros")),
            output="screen" if screen else node.output,
            log_file=log,
        )


def _value(text: str) -> bool | int | float | str | list[object] | dict[str, object]:
    """A `_name:=value` of a node's arguments: YAML where it is YAML, else the text."""
    try:
        value = yaml.safe_load(text)
    except yaml.YAMLError:
        return text
    return text if value is None else value
