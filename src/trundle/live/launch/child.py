"""`trundle launch --child`: runs the nodes that the parent, a roslaunch on another machine, assigns to this one.

The parent starts it over ssh, then both call each other over XML-RPC, as roslaunch and its children do.
"""

import asyncio
import os
import sys
import threading
from collections.abc import Mapping
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import Any

from trundle.base.console import Console
from trundle.base.diagnostics import Diagnostics, TrundleError, UsageError
from trundle.base.signals import StopFlag, stop_flag
from trundle.base.supervisor import Event
from trundle.page.network_warning import warn_of_network
from trundle.robots.launch import read_launch_text
from trundle.robots.packages import Packages
from trundle.ros import GraphLoop, MasterProxy, RpcServer, UnknownMethodError, master_uri_from_env, server_address

from .loaded_launch import LoadedLaunch
from .nodes import LaunchedNode
from .options import LaunchOptions
from .parent import ParentLaunch
from .running_nodes import RunningNodes
from .session import LaunchSession


def run_child(parent: ParentLaunch, options: LaunchOptions, environment: Mapping[str, str] | None = None) -> int:
    """Serve the parent until its shutdown call, every node's end, or Ctrl-C; return 1 if a required node died.

    Raises:
        UsageError: the parent cannot be reached, or refuses this child.
    """
    env = dict(os.environ if environment is None else environment)
    warn_of_network(options.host, Console(sys.stderr, Diagnostics()).line)
    with stop_flag() as stop, parent, GraphLoop() as loop:
        child = _Child(parent, options, env, stop)
        server = RpcServer(child.answer)
        address = server_address(options.host)
        loop.run(server.start(address.bind, 0))
        try:
            parent.register(f"http://{address.authority(server.port)}/", address.bind)
            while not stop.wait(0.05) and not child.is_over:
                pass
        finally:
            child.stop_nodes()
            loop.run(server.stop())
        if child.required_died:
            return 1
        return 130 if stop.is_set() and not child.is_shutdown_requested else 0


class _Child:
    """XML-RPC server of the parent's calls, and the launches that they started."""

    def __init__(self, parent: ParentLaunch, options: LaunchOptions, env: Mapping[str, str], stop: StopFlag) -> None:
        self._parent = parent
        self._options = replace(options, summary=False)
        self._env = env
        self._stop = stop
        self._launches = ExitStack()
        self._busy = threading.Lock()
        """Held while nodes start or stop on a thread of the pool."""
        self._running: list[RunningNodes] = []
        self._starts: dict[str, int] = {}
        self._codes: dict[str, int] = {}
        """Process → exit code, of ended processes that were not respawned."""
        self._is_ending = False
        self.is_shutdown_requested = False

    @property
    def is_over(self) -> bool:
        """True if all launched nodes have ended, or a required one has."""
        if self._busy.locked() or not self._running:
            return False
        return self.required_died or (bool(self._starts) and all(nodes.is_over for nodes in self._running))

    @property
    def required_died(self) -> bool:
        """True if a required node has ended."""
        return any(nodes.required_died for nodes in self._running)

    async def answer(self, method: str, arguments: list[Any]) -> object:
        """Answer a call; nodes start and stop on another thread meanwhile."""
        match method, arguments:
            case "get_pid", []:
                return 1, str(os.getpid()), os.getpid()
            case "get_node_names", []:
                return 1, "node names", [name for name in self._starts if name not in self._codes]
            case "list_processes", []:
                alive = [[name, count] for name, count in self._starts.items() if name not in self._codes]
                dead = [[name, self._starts[name]] for name in self._codes]
                return 1, "processes on this machine", [alive, dead]
            case "process_info", [str(name)] if name in self._starts:
                info = {"name": name, "alive": name not in self._codes, "spawn_count": self._starts[name]}
                return 1, "process info", info | ({"exit_code": self._codes[name]} if name in self._codes else {})
            case "process_info", [_]:
                return -1, "no process by that name", dict[str, object]()
            case "launch", [str(xml)]:
                return await asyncio.to_thread(self._launch, xml)
            case "shutdown", []:
                await asyncio.to_thread(self.stop_nodes)
                self.is_shutdown_requested = True
                self._stop.set()
                return 1, "success", 1
            case _:
                raise UnknownMethodError(f'method "{method}" is not supported with {len(arguments)} arguments')

    def stop_nodes(self) -> None:
        """Stop all launches, newest first, and refuse new ones."""
        self._is_ending = True
        with self._busy:
            self._launches.close()

    def _launch(self, xml: str) -> tuple[int, str, list[list[str]]]:
        """Start nodes; return (code, message, [names started, names not started])."""
        try:
            loaded = self._read(xml)
        except TrundleError as error:
            return -1, f"ERROR: {error}", [[], []]
        self._parent.log("launching nodes...")
        with self._busy, ExitStack() as opened:
            try:
                if self._is_ending:
                    raise UsageError("it is shutting down")
                self._check_run()
                session = opened.enter_context(LaunchSession(loaded, self._options, listener=self._notify_parent))
                running = session.start(loaded.plan.nodes, is_ending=lambda: self._is_ending)
            except TrundleError as error:
                return 0, f"ERROR: {error}", [[], []]
            self._running.append(running)
            self._launches.push(opened.pop_all())
        for warning in loaded.report.printed_warnings():
            self._parent.log(warning, error=True)
        self._parent.log("... done launching nodes")
        names = [[_process_name(n) for n in running.launched if (n.job is not None) is runs] for runs in (True, False)]
        return 1, "launched", names

    def _read(self, xml: str) -> LoadedLaunch:
        report = Diagnostics(strict=self._options.strict)
        folder = Path.cwd()
        packages = Packages(self._env, start=folder)
        plan = read_launch_text(xml, name=self._parent.uri, packages=packages, report=report, env=self._env)
        if plan.params or plan.clear_params or plan.steps:
            raise UsageError("a child sets no parameters; its parent does")
        show = Console(sys.stderr, report)
        return LoadedLaunch(
            plan=plan, params=(), packages=packages, start=folder, env=self._env, report=report, show=show
        )

    def _check_run(self) -> None:
        master = MasterProxy(self._env.get("ROS_MASTER_URI") or master_uri_from_env())
        if (run_id := master.call("getParam", "/run_id")) != self._parent.run_id:
            raise UsageError(f"the master at {master.uri} has the run_id {run_id}, not {self._parent.run_id}")

    def _notify_parent(self, event: Event, text: str) -> None:
        if event.kind == "started":
            self._starts[event.name] = self._starts.get(event.name, 0) + 1
            self._codes.pop(event.name, None)
        if event.code is not None:
            self._codes[event.name] = event.code
            self._parent.process_died(event.name, event.code)
        self._parent.log(text, error=event.kind in ("died", "failed", "required"))


def _process_name(launched: LaunchedNode) -> str:
    return launched.node.name if launched.job is None else f"Process<{launched.job.name}>"
