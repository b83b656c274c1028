"""`trundle launch`: a launch file's parameters set and its nodes running, until they end or Ctrl-C."""

import asyncio
import os
import sys
from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import yaml

from trundle.description import expand_xacro
from trundle.diagnostics import DescriptionError, Diagnostics
from trundle.launch import LaunchParam, LaunchPlan, read_launch, resolve_params
from trundle.nodes import Host
from trundle.packages import Packages
from trundle.ros import Node, follow_time
from trundle.supervisor import Event, Supervisor
from trundle.viewer import GraphPage

from .exposure import warn_of_exposure
from .graph import Graph
from .launch_nodes import NodeStarter
from .launch_words import read_words
from .showing import Showing
from .signals import stop_flag

NS = 1_000_000_000
_START_S = 60.0
"""Starting programs takes its time on a busy machine."""
_STOP_S = 30.0
"""roslaunch's patience with a program: 15 s to obey SIGINT, 2 s to obey SIGTERM."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LaunchOptions:
    """How to launch; the defaults are those of `trundle launch`."""

    headless: bool = False
    duration_s: float | None = None
    """ROS time; None: until every node has ended."""
    master_port: int | None = None
    view_port: int | None = None
    host: str = "127.0.0.1"
    screen: bool = False
    strict: bool = False
    only: Literal["nodes", "arguments", "params"] | None = None
    """Print these and start nothing."""


def launch(words: Sequence[str], options: LaunchOptions, environment: Mapping[str, str] | None = None) -> int:
    """Launch; return the exit code: 0 when every node has ended or the time is over, 1 when a required one died.

    Args:
        words: of the command line: PKG FILE or FILE…, and NAME:=VALUE.
        options: how.
        environment: None: the process's own.

    Raises:
        TrundleError: the files, or the request, are at fault.
    """
    env = dict(os.environ if environment is None else environment)
    if options.master_port is not None:
        env["ROS_MASTER_URI"] = f"http://localhost:{options.master_port}"
    report = Diagnostics(strict=options.strict)
    show = Showing(sys.stderr, report)
    packages = Packages(env, start=Path.cwd())
    request = read_words(words, packages)
    packages = packages.around(request.files[0])
    plan = read_launch(request.files, packages=packages, report=report, arguments=request.arguments, env=env)
    show.findings()
    if options.only in ("nodes", "arguments"):
        print(_nodes(plan) if options.only == "nodes" else _arguments(plan))
        return 0

    def expand(file: Path, arguments: Mapping[str, str]) -> str:
        return expand_xacro(file, arguments, packages=packages, report=report)

    params = resolve_params(plan, report, expand_xacro=expand, env=env)
    show.findings()
    if options.only == "params":
        print(yaml.safe_dump({param.name: param.value for param in params}, sort_keys=True).rstrip())
        return 0
    warn_of_exposure(options.host, show.line)
    with stop_flag() as stop, ExitStack() as open_things:
        graph = open_things.enter_context(Graph.open(env, host=options.host, any_port=False))
        show.line(graph.story)
        launcher = Node("/roslaunch", loop=graph.loop, master_uri=graph.master_uri, host=graph.host, rosout=False)
        graph.loop.run(_set_params(launcher, plan, params))
        clock = graph.loop.run(follow_time(launcher))
        page = None
        if not options.headless:
            page = GraphPage(packages=packages, report=report, host=options.host, port=options.view_port)
            open_things.callback(page.close)
        starter = NodeStarter(
            graph=graph, packages=packages, env=env, report=report, host=Host(display=page), log_folder=_logs(env)
        )
        running = _Running(starter, plan, show, screen=options.screen)
        try:
            graph.loop.run(running.start(), timeout_s=_START_S)
            show.findings()
            end_ns = None if options.duration_s is None else clock.now_ns() + round(options.duration_s * NS)
            while not stop.wait(0.05) and not running.over and (end_ns is None or clock.now_ns() < end_ns):
                show.findings()
        finally:
            graph.loop.run(running.stop(), timeout_s=_STOP_S)
        if stop.is_set():
            return 130
        return 1 if running.required_died else 0


class _Running:
    """The nodes of one launch under their supervisor, on the graph's loop."""

    def __init__(self, starter: NodeStarter, plan: LaunchPlan, show: Showing, *, screen: bool) -> None:
        self._starter = starter
        self._plan = plan
        self._show = show
        self._screen = screen
        self._supervisor: Supervisor | None = None
        self._waiting: asyncio.Task[str | None] | None = None

    async def start(self) -> None:
        self._supervisor = Supervisor(self._tell)
        for node in self._plan.nodes:
            job = self._starter.job(node, screen=self._screen, show=self._show_output)
            if job is not None:
                await self._supervisor.start(job, self._starter.policy(node))
        self._waiting = asyncio.create_task(self._supervisor.wait())

    async def stop(self) -> None:
        if self._supervisor is not None:
            await self._supervisor.stop()

    @property
    def over(self) -> bool:
        """Whether every node has ended, or a required one."""
        return self._waiting is not None and self._waiting.done()

    @property
    def required_died(self) -> bool:
        return self.over and self._waiting is not None and self._waiting.result() is not None

    def _tell(self, event: Event) -> None:
        self._show.line(f"[{event.name}] {event.text}")

    def _show_output(self, name: str, line: str) -> None:
        del name  # the original prints a node's own lines as they are
        self._show.line(line)


async def _set_params(node: Node, plan: LaunchPlan, params: Sequence[LaunchParam]) -> None:
    """Clear, set, then dump and delete, in roslaunch's order; all before any node starts."""
    await node.ready()
    for namespace in plan.clear_params:
        if await node.has_param(namespace):
            await node.delete_param(namespace)
    for param in params:
        await node.set_param(param.name, param.value)
    for step in plan.steps:
        if step.command == "delete":
            if await node.has_param(step.name):
                await node.delete_param(step.name)
            continue
        try:
            Path(step.file).write_text(yaml.safe_dump(await node.get_param(step.name)))
        except OSError as error:
            raise DescriptionError(step.at, f"rosparam dump to {step.file!r}: {error.strerror}") from None


def _logs(env: Mapping[str, str]) -> Path:
    """Where programs log to, by ROS_LOG_DIR and ROS_HOME as in ROS."""
    home = Path(env.get("ROS_HOME") or Path(env.get("HOME", "/tmp")) / ".ros")
    return Path(env["ROS_LOG_DIR"]) if env.get("ROS_LOG_DIR") else home / "log"


def _nodes(plan: LaunchPlan) -> str:
    return "\n".join(node.full_name for node in plan.nodes)


def _arguments(plan: LaunchPlan) -> str:
    required = [a for a in plan.arguments if a.required]
    optional = [a for a in plan.arguments if not a.required and a.default is not None]
    lines: list[str] = []
    if required:
        lines += ["Required Arguments:", *(f"  {a.name}: {a.doc or 'undocumented'}" for a in required)]
    if optional:
        lines += ["Optional Arguments:"]
        lines += [f'  {a.name} (default "{a.default}"): {a.doc or "undocumented"}' for a in optional]
    return "\n".join(lines) or "No arguments."
