"""Supervised nodes of one launch, and the lines printed about them."""

import asyncio
import re
from collections.abc import Awaitable, Callable, Sequence
from typing import TypeAlias

from trundle.base.console import say
from trundle.base.supervisor import Event, StopTimeouts, Supervisor
from trundle.gazebo.nodes import WORLDS, missing_ros_module, missing_rospy_advice
from trundle.robots.launch import LaunchNode

from .nodes import LaunchedNode, NodeStarter
from .terminals import exec_command

_RULE = "=" * 80
_NO_TERMINAL = re.compile("Inappropriate ioctl for device|EOFError: EOF when reading a line|_curses.error")
"""Output of programs that read keys but have no terminal."""

Listener: TypeAlias = Callable[[Event, str], None]
"""Called with an event of a node, and its printed line."""


class RunningNodes:
    """Starts, watches and stops the nodes, on the graph's loop."""

    def __init__(
        self,
        starter: NodeStarter,
        nodes: Sequence[LaunchNode],
        *,
        timeouts: StopTimeouts,
        quiet: bool,
        listener: Listener,
    ) -> None:
        """Prepare; `quiet`: print failures only."""
        self._starter = starter
        self._nodes = nodes
        self._timeouts = timeouts
        self._listener = listener
        self._silent_kinds = {"started", "finished", "stopping"} if quiet else set[str]()
        self._supervisor: Supervisor | None = None
        self._waiting: asyncio.Task[str | None] | None = None
        self._by_label: dict[str, LaunchedNode] = {}
        self._worlds: set[str] = set()
        self._ended: set[str] = set()
        self.launched: list[LaunchedNode] = []
        """Nodes as started, in the file's order."""

    async def start(
        self, is_ending: Callable[[], bool], let_start: Callable[[Callable[[], bool]], Awaitable[None]] | None = None
    ) -> None:
        """Start all nodes that can run, until `is_ending`; await `let_start` after each."""
        self._supervisor = Supervisor(self._print_event, timeouts=self._timeouts)
        for number, node in enumerate(self._nodes, start=1):
            if is_ending():
                break
            label = f"{node.full_name.strip('/')}-{number}"
            if (node.package, node.type) in WORLDS:
                self._worlds.add(label)
            launched = self._starter.prepare(node, label, show=_show_output)
            if launched.job is not None:
                self._by_label[label] = launched
                if not await self._supervisor.start(launched.job, self._starter.policy(node)):
                    launched = launched.failed()
            self.launched.append(launched)
            if let_start is not None:
                await let_start(is_ending)
        self._waiting = asyncio.create_task(self._supervisor.wait())

    async def stop(self) -> None:
        """Stop all nodes, the last one first."""
        if self._supervisor is not None:
            await self._supervisor.stop()

    @property
    def is_over(self) -> bool:
        """True if every node has ended, or a required one has."""
        return self._waiting is not None and self._waiting.done()

    @property
    def required_died(self) -> bool:
        """True if the end of a required node ended the launch."""
        return self.is_over and self._waiting is not None and self._waiting.result() is not None

    @property
    def required_failed(self) -> bool:
        """True if a required node ended the launch with another exit code than 0."""
        name = self._waiting.result() if self.is_over and self._waiting is not None else None
        return name is not None and self._supervisor is not None and self._supervisor.exit_codes()[name] != 0

    def has_world_ended(self) -> bool:
        """True if worlds were started and all have ended."""
        return bool(self._worlds) and self._worlds <= self._ended

    def _print_event(self, event: Event) -> None:
        name = event.name
        launched = self._by_label[name]
        if event.kind == "started":
            self._ended.discard(name)
            if launched.terminal is not None:
                launched.terminal.begin()
        elif event.kind in ("failed", "finished", "died"):
            self._ended.add(name)
            self._starter.terminals.recover()
            if launched.terminal is not None:
                launched.terminal.end(f"{launched.node.full_name} {event.text.partition(';')[0]}")
        match event.kind:
            case "started":
                text = f"process[{name}]: {event.text}"
            case "finished" | "died":
                log = launched.log_files
                text = f"[{name}] process {event.text}{log and f'{chr(10)}log file: {log}'}"
                if module := missing_ros_module(event.text):
                    text = f"{text}\n[{name}] {missing_rospy_advice(module)}"
                elif launched.terminal is None and _NO_TERMINAL.search(event.text):
                    text = f"{text}\n[{name}] {_terminal_advice(launched.node)}"
            case "required":
                text = f"{_RULE}\nREQUIRED process [{name}] has died!\nInitiating shutdown!\n{_RULE}"
            case _:
                text = f"[{name}] {event.text}"
        self._listener(event, text)
        if event.kind not in self._silent_kinds:
            say(text)


def launched_table(launched: Sequence[LaunchedNode], page: str | None = None) -> str:
    """Table of the nodes (process, stand-in, missing or failed), and the URL of the page."""
    rows = [(entry.kind, entry.node.full_name, entry.detail) for entry in launched]
    widths = [max((len(row[column]) for row in rows), default=0) for column in (0, 1)]
    return "\n".join(
        [
            "WHAT RUNS",
            *(f"  {kind:<{widths[0]}}  {name:<{widths[1]}}  {detail}" for kind, name, detail in rows),
            *([] if page is None else [f"  {'page':<{widths[0]}}  {page}"]),
        ]
    )


def _terminal_advice(node: LaunchNode) -> str:
    return (
        f'it reads keys, and has no terminal: launch-prefix="xterm -e" gives it one on the page; '
        f"or run it by itself: {exec_command(node)}"
    )


def _show_output(_name: str, line: str) -> None:
    say(line)  # like roslaunch, without a prefix
