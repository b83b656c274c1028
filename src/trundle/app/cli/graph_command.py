"""Common parts of commands on a running graph: names, master proxy, node, error messages."""

import argparse
import functools
import os
import signal
import sys
import threading
from argparse import Namespace
from collections.abc import Callable, Generator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from trundle.base.diagnostics import TrundleError
from trundle.base.interrupts import ending_signals, interrupt, interrupt_main_thread
from trundle.robots.names import Arguments, anonymous_name, resolve_name
from trundle.ros import MasterProxy, MasterUnreachableError, master_uri_from_env

if TYPE_CHECKING:
    from trundle.ros import GraphLoop, Node


class IntermixedParser(argparse.ArgumentParser):
    """Parser that allows options between positional arguments: `pub /cmd_vel geometry_msgs/Twist -r 10 -- '…'`."""

    _is_inside = False

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:  # pyright: ignore[reportIncompatibleMethodOverride]
        if self._is_inside:
            return super().parse_known_args(args, namespace)
        self._is_inside = True
        try:
            return self.parse_known_intermixed_args(args, namespace)
        finally:
            self._is_inside = False


def ros_errors(function: Callable[[Namespace], int]) -> Callable[[Namespace], int]:
    """Report errors of a graph command on stderr, as rostopic does, and return `args.failure` or 1.

    If no master answers, return `args.alone` or 1.
    """

    @functools.wraps(function)
    def reporting(args: Namespace) -> int:
        try:
            return function(args)
        except MasterUnreachableError as error:
            print(f"ERROR: Unable to communicate with master!\n{error}", file=sys.stderr)
            return getattr(args, "alone", 1)
        except TrundleError as error:
            print(f"ERROR: {error}", file=sys.stderr)
        return getattr(args, "failure", 1)

    return reporting


def global_name(name: str, script: str) -> str:
    """Resolve a name from the command line, relative to ROS_NAMESPACE."""
    namespace = "/" + os.environ.get("ROS_NAMESPACE", "").strip("/")
    return resolve_name(name, f"{namespace.rstrip('/')}/{script}")


def master(script: str) -> MasterProxy:
    """Return a proxy of the master at ROS_MASTER_URI."""
    return MasterProxy(caller_id=f"/{script}")


@contextmanager
def running_node(base: str, words: Arguments | None = None) -> Generator["tuple[GraphLoop, Node]"]:
    """Run an anonymous node; shut it down on exit, Ctrl-C and `rosnode kill`.

    Args:
        base: prefix of the node's name.
        words: name and remappings from the command line.
    """
    from trundle.ros import GraphLoop, Node

    words = words or Arguments()
    MasterProxy(caller_id=f"/{base}").call("getPid")
    with interrupted_by_signals(), GraphLoop() as loop:
        name = words.name or anonymous_name(base)
        node = Node(
            name,
            loop=loop,
            master_uri=master_uri_from_env(),
            namespace=os.environ.get("ROS_NAMESPACE", "/"),
            remappings=words.remappings,
            rosout=False,
        )
        if threading.current_thread() is threading.main_thread():
            node.on_shutdown(lambda _: interrupt_main_thread())
        yield loop, node


@contextmanager
def interrupted_by_signals() -> Generator[None]:
    """Make SIGTERM and SIGHUP raise KeyboardInterrupt, as SIGINT does."""
    if threading.current_thread() is not threading.main_thread():  # only the main thread handles signals
        yield
        return
    old_handlers = {number: signal.signal(number, interrupt) for number in ending_signals()}
    try:
        yield
    finally:
        for number, handler in old_handlers.items():
            signal.signal(number, handler)
