"""`trundle launch`: a launch file's parameters set and its nodes running, until they end or Ctrl-C."""

import os
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from threading import Event
from typing import Literal

from trundle.description import expand_xacro
from trundle.diagnostics import Diagnostics
from trundle.launch import LaunchParam, LaunchPlan, read_arguments, read_launch, resolve_params
from trundle.nodes import Host
from trundle.packages import Packages
from trundle.ros import Clock, MasterProxy, MasterUnreachableError, Node, follow_time, master_uri_from_env
from trundle.supervisor import Patience
from trundle.viewer import GraphPage

from . import launch_print
from .exposure import warn_of_exposure
from .gazebo_world import GazeboWorld
from .graph import Graph
from .launch_logs import log_folder
from .launch_nodes import NodeStarter
from .launch_params import set_params
from .launch_running import RunningNodes, what_runs
from .launch_words import LaunchRequest, read_words
from .showing import Showing
from .signals import stop_flag

NS = 1_000_000_000
_START_S = 60.0
"""Starting programs takes its time on a busy machine."""
_SILENCE_S = 5.0
_LAST_S = 13.0
"""What stopping may take beyond the patience with each program."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LaunchOptions:
    """How to launch; the defaults are those of `trundle launch`."""

    headless: bool = False
    duration_s: float | None = None
    """ROS time; None: until every node has ended."""
    master_port: int | None = None
    view_port: int | None = None
    host: str = "127.0.0.1"
    output: Literal["screen", "log"] | None = None
    """Of every node, whatever the file says."""
    all_required: bool = False
    wait_for_master: bool = False
    summary: bool = True
    verbose: bool = False
    core_only: bool = False
    pid_file: Path | None = None
    patience: Patience = Patience()
    strict: bool = False
    only: Literal["nodes", "files", "find-node", "args", "arguments", "params"] | None = None
    """Print these and start nothing."""
    node: str = ""
    """Which node `find-node` and `args` are about."""


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
    request = LaunchRequest() if options.core_only else read_words(words, packages)
    if request.files:
        packages = packages.around(request.files[0])
    if options.only == "arguments":
        for file in request.files:
            declared = read_arguments(file, packages=packages, report=report, arguments=request.arguments, env=env)
            print(launch_print.arguments(declared))
        return 0
    plan = read_launch(
        request.files, packages=packages, report=report, arguments=request.arguments, texts=request.texts, env=env
    )
    show.findings()
    if options.only is not None and options.only != "params":
        print(_printed(options, plan, packages, env))
        return 0

    def expand(file: Path, arguments: Mapping[str, str]) -> str:
        return expand_xacro(file, arguments, packages=packages, report=report)

    params = resolve_params(plan, report, expand_xacro=expand, env=env)
    show.findings()
    if options.only == "params":
        print(launch_print.parameters(params))
        return 0
    warn_of_exposure(options.host, show.line)
    if options.verbose:
        _tell_everything(plan, params, show.line)
    with stop_flag() as stop:
        if options.wait_for_master and not _wait_for_master(env, stop, show.line):
            return 130
        return _run(plan, params, packages, env, options, show, report, stop)


def _run(
    plan: LaunchPlan,
    params: Sequence[LaunchParam],
    packages: Packages,
    env: Mapping[str, str],
    options: LaunchOptions,
    show: Showing,
    report: Diagnostics,
    stop: Event,
) -> int:
    with ExitStack() as open_things:
        if options.pid_file is not None:
            options.pid_file.expanduser().write_text(str(os.getpid()))
        graph = open_things.enter_context(Graph.open(env, host=options.host, any_port=False))
        show.line(graph.story)
        launcher = Node("/roslaunch", loop=graph.loop, master_uri=graph.master_uri, host=graph.host, rosout=False)
        if options.summary and not options.core_only:
            known = {
                name: graph.loop.run(launcher.get_param(name, "")).strip() for name in ("/rosdistro", "/rosversion")
            }
            print(launch_print.summary(plan, {**known, **{p.name: p.value for p in params}}), flush=True)
        graph.loop.run(set_params(launcher, plan, params), timeout_s=_START_S)
        clock = graph.loop.run(follow_time(launcher))
        page = None
        if not options.headless:
            page = GraphPage(packages=packages, report=report, host=options.host, port=options.view_port)
            open_things.callback(page.close)
        logs = log_folder(env, graph.loop.run(launcher.get_param("/run_id", "")))
        gazebo = GazeboWorld(
            graph=graph,
            packages=packages,
            env=env,
            report=report,
            folder=logs / "spawned",
            say=show.line,
            window=None if options.headless else (options.host, options.view_port),
        )
        open_things.callback(gazebo.close)
        starter = NodeStarter(
            graph=graph,
            packages=packages,
            env=env,
            report=report,
            host=Host(display=page, simulator=gazebo),
            log_folder=logs,
            output=options.output,
            all_required=options.all_required,
        )
        running = RunningNodes(starter, plan.nodes, patience=options.patience)
        try:
            graph.loop.run(running.start(), timeout_s=_START_S)
            show.findings()
            if running.launched:
                print(what_runs(running.launched), flush=True)
            end_ns = None if options.duration_s is None else clock.now_ns() + round(options.duration_s * NS)
            over = False
            silent = _SilentClock(clock, show.line)
            while not stop.wait(0.05) and not over and (end_ns is None or clock.now_ns() < end_ns):
                show.findings()
                silent.look()
                over = running.over and not options.core_only
        finally:
            patience_s = options.patience.interrupt_s + options.patience.terminate_s
            graph.loop.run(running.stop(), timeout_s=patience_s + _LAST_S)
        if stop.is_set():
            return 130
        return 1 if running.required_died else 0


class _SilentClock:
    """Says once that simulated time is waited for and nobody tells it, which makes every node stand still."""

    def __init__(self, clock: Clock, say: Callable[[str], None]) -> None:
        self._clock = clock
        self._say: Callable[[str], None] | None = say
        self._due = time.monotonic() + _SILENCE_S

    def look(self) -> None:
        """See whether there is a time by now."""
        if self._say is None or self._clock.now_ns() > 0:
            self._say = None
        elif time.monotonic() > self._due:
            self._say("/use_sim_time is true, but nothing has published a time on /clock yet (a simulation, a bag?)")
            self._say = None


def _printed(options: LaunchOptions, plan: LaunchPlan, packages: Packages, env: Mapping[str, str]) -> str:
    match options.only:
        case "nodes":
            return launch_print.node_names(plan)
        case "files":
            return launch_print.file_names(plan)
        case "find-node":
            return launch_print.node_file(plan, options.node)
        case _:
            return launch_print.node_command(plan, options.node, packages, env)


def _tell_everything(plan: LaunchPlan, params: Sequence[LaunchParam], say: Callable[[str], None]) -> None:
    for file in plan.files:
        say(f"... loading XML file [{file}]")
    for param in params:
        say(f"Added parameter [{param.name}]")
    for node in plan.nodes:
        say(f"Added node of type [{node.package}/{node.type}] in namespace [{node.namespace}]")


def _wait_for_master(env: Mapping[str, str], stop: Event, say: Callable[[str], None]) -> bool:
    """Wait until a master answers; False: somebody asked to stop first."""
    proxy = MasterProxy(env.get("ROS_MASTER_URI") or master_uri_from_env(), timeout_s=2.0)
    said = False
    while True:
        try:
            proxy.call("getPid")
        except MasterUnreachableError:
            if not said:
                say("roscore/master is not yet running, will wait for it to start")
            said = True
        else:
            say("master has started, initiating launch")
            return True
        if stop.wait(0.1):
            return False
