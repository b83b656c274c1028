"""Check the environment and the running graph, as roswtf does."""

import argparse
import os
from pathlib import Path
from typing import TYPE_CHECKING

from ..quiet_imports import quiet_imports

if TYPE_CHECKING:
    from collections.abc import Sequence

EXAMPLES = """
  roswtf                        the environment and the running graph
"""
_RULE = "=" * 80


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("file", nargs="?", metavar="LAUNCH_FILE", help="also check this launch file")
    parser.add_argument("--all", action="store_true", help=argparse.SUPPRESS)


def main(args: argparse.Namespace) -> int:
    """Print a summary of static checks, then one of the graph's checks."""
    with quiet_imports():
        from trundle.app.doctor.environment_checks import environment_checks
        from trundle.app.doctor.graph_faults import graph_faults
        from trundle.ros import MasterProxy, MasterUnreachableError, master_uri_from_env

    print(f"{_RULE}\nStatic checks summary:\n")
    checks = environment_checks(os.environ, Path.cwd())
    _print_summary([f"ERROR {check.name}: {check.cost}" for check in checks if check.state == "problem"], [])
    if args.file is not None:
        args.run_command(("check",), [args.file])
    print(_RULE)
    try:
        proxy = MasterProxy(caller_id="/roswtf", timeout_s=2.0)
        proxy.call("getPid")
        print("Beginning tests of your ROS graph. These may take a while...\nanalyzing graph...", flush=True)
        faults = graph_faults(proxy)
    except MasterUnreachableError:
        print("ROS Master does not appear to be running.\nOnline graph checks will not be run.")
        print(f"ROS_MASTER_URI is [{master_uri_from_env()}]")
        return 0
    print("... done analyzing graph\n\nOnline checks summary:\n")
    _print_summary([str(f) for f in faults if f.is_error], [str(f) for f in faults if not f.is_error])
    return 0


def _print_summary(errors: "Sequence[str]", warnings: "Sequence[str]") -> None:
    if not errors and not warnings:
        print("No errors or warnings")
    if warnings:
        print(f"Found {len(warnings)} warning(s).")
        print("Warnings are things that may be just fine, but are sometimes at fault\n")
        print("\n".join(f"{line}\n" for line in warnings))
    if errors:
        print(f"Found {len(errors)} error(s).\n")
        print("\n".join(f"{line}\n" for line in errors))
