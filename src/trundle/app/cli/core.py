"""Run the ROS master, the parameter server and /rosout, as roscore does."""

import argparse
import os
import signal
import socket
import sys
from contextlib import suppress
from pathlib import Path
from queue import Empty, SimpleQueue

from trundle.base.diagnostics import UsageError
from trundle.base.interrupts import ending_signals
from trundle.live.launch.logs import log_folder
from trundle.page.network_warning import warn_of_network
from trundle.ros import DISTROS, NOETIC, Core, GraphLoop, RosError, host_and_port

EXAMPLES = """
  trundle core                  default address: http://localhost:11311
  trundle core -p 11312         beside another master
"""
_CONNECT_S = 10.0
"""Timeout of a connection to this process [s]; the operating system accepts it, however slow the process is."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("-p", "--port", type=int, default=11311, help="port to listen on; 0: any free one")
    parser.add_argument("--host", help="address to bind, such as 0.0.0.0 for all interfaces; loopback by default")
    parser.add_argument("--distro", choices=DISTROS, default=NOETIC.distro, help="ROS distribution to present (noetic)")
    # roscore's options for worker threads, sockets and logs have no effect here.
    parser.add_argument("-v", "--verbose", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("-w", "--numworkers", type=int, help=argparse.SUPPRESS)
    for option in (("-t", "--timeout"), ("--sigint-timeout",), ("--sigterm-timeout",)):
        parser.add_argument(*option, type=float, help=argparse.SUPPRESS)
    parser.add_argument("--master-logger-level", help=argparse.SUPPRESS)


def main(args: argparse.Namespace) -> int:
    """Run until Ctrl-C, SIGTERM, SIGHUP, or a shutdown request."""
    if not 0 <= args.port < 65536:
        raise UsageError(f"a port lies between 0 and 65535, got {args.port}")
    reasons: SimpleQueue[str] = SimpleQueue()  # unlike an Event, safe to use in a signal handler
    for number in ending_signals()[1:]:
        signal.signal(number, lambda _number, _frame: reasons.put("terminated"))
    _warn_of_other_master(os.environ.get("ROS_MASTER_URI"), args.port)
    with GraphLoop() as loop:
        core = Core(
            loop,
            port=args.port,
            host=args.host,
            profile=DISTROS[args.distro],
            on_shutdown=reasons.put,
            log_folder=_log_folder,
        )
        loop.run(core.start())
        if args.host is not None:
            warn_of_network(args.host, lambda line: print(line, file=sys.stderr, flush=True))
        _check_address(core.uri)
        loop.run(core.wait_ready())
        print(f"ROS_MASTER_URI={core.uri}", flush=True)
        print(f"started core service [/rosout]; run_id {core.run_id}; Ctrl-C stops it", file=sys.stderr, flush=True)
        try:
            reason = _next_reason(reasons)
        finally:
            loop.run(core.stop())
    print(f"core stopped: {reason}", file=sys.stderr)
    return 0


def _check_address(uri: str) -> None:
    """Raise a RosError if nothing listens at the address that the master advertises."""
    try:
        socket.create_connection(host_and_port(uri), timeout=_CONNECT_S).close()
    except OSError:
        raise RosError(
            f"nothing answers at {uri}, the address that this master advertises; "
            "set ROS_IP or ROS_HOSTNAME to an address of this machine, or neither"
        ) from None


def _warn_of_other_master(uri: str | None, port: int) -> None:
    """Warn, in roscore's words, if ROS_MASTER_URI names another master."""
    if not uri:
        return
    try:
        host, named_port = host_and_port(uri)
    except RosError as error:
        print(f"WARNING: ROS_MASTER_URI is {error}", file=sys.stderr, flush=True)
        return
    if not _is_local(host):
        print(f"WARNING: ROS_MASTER_URI [{uri}] host is not set to this machine", file=sys.stderr, flush=True)
    elif port not in (0, named_port):
        warning = f"WARNING: ROS_MASTER_URI port [{named_port}] does not match this roscore [{port}]"
        print(f"{warning}; unset it, or start this one with -p {named_port}", file=sys.stderr, flush=True)


def _is_local(host: str) -> bool:
    with socket.socket(socket.AF_INET6 if ":" in host else socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.bind((host, 0))
        except OSError:
            return False
    return True


def _log_folder(run_id: str) -> Path | None:
    try:
        folder = log_folder(os.environ, run_id)
    except UsageError as error:
        print(f"no logs are written: {error}", file=sys.stderr, flush=True)
        return None
    print(f"... logging to {folder}", file=sys.stderr, flush=True)
    return folder


def _next_reason(reasons: SimpleQueue[str]) -> str:
    while True:
        with suppress(Empty):
            return reasons.get(timeout=1.0)  # wakes up for Ctrl-C, on Windows too
