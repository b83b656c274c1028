"""All checks of `trundle doctor`."""

from collections.abc import Mapping
from pathlib import Path

from trundle.ros import MasterProxy, RosError

from .check import Check
from .environment_checks import environment_checks
from .graph_faults import graph_faults
from .machine import machine_checks


def examine(environment: Mapping[str, str], start: Path) -> list[Check]:
    """Check this machine, its environment and the running graph, if there is one.

    Args:
        environment: environment variables of the commands.
        start: working folder.
    """
    return [*machine_checks(environment), *environment_checks(environment, start), *_graph(environment)]


def _graph(environment: Mapping[str, str]) -> list[Check]:
    try:
        faults = graph_faults(
            MasterProxy(environment.get("ROS_MASTER_URI") or None, caller_id="/doctor", timeout_s=2.0)
        )
    except RosError:
        return []
    if not faults:
        return [Check(name="graph", state="ok", found="every node answers, every subscription is connected")]
    return [
        Check(
            name="graph",
            state="problem" if fault.is_error else "missing",
            found=fault.what.removesuffix(":"),
            cost=", ".join(fault.names),
        )
        for fault in faults
    ]
