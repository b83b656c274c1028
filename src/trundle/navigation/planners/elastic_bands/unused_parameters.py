"""Parameters of a planner that act on nothing."""

from collections.abc import Set as AbstractSet

from trundle.robots.parameters import RosParameters
from trundle.ros import Node


def report_unused(
    node: Node, section: RosParameters, planner: str, *, used: AbstractSet[str], without_effect: AbstractSet[str]
) -> None:
    """Log which parameters of a section act on nothing here, and which the original planner does not have."""
    names = set(section.names())
    if unused := sorted(names & without_effect):
        node.log.warn(f"{section.namespace}: parameters without effect: {', '.join(unused)}")
    if unknown := sorted(names - without_effect - used):
        node.log.warn(f"{section.namespace}: {planner} has no parameters {', '.join(unknown)}")
