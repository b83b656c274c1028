"""Tests of nodes, run by `trundle test`."""

import sys
from collections.abc import Sequence
from typing import Any

import rosgraph
from rosunit import unitrun

XML_OUTPUT_FLAG = "--gtest_output=xml:"


def rosrun(package: str, test_name: str, test: Any, sysargs: Sequence[str] | None = None) -> None:
    """Run a unittest and write its results where `trundle test` reads them; exits with 1 if it fails.

    Args:
        package: test's package.
        test_name: name of the results.
        test: TestCase, or a suite's name.
        sysargs: command line; default: sys.argv.
    """
    unitrun(package, test_name, test, sysargs=rosgraph.myargv(list(sys.argv if sysargs is None else sysargs)))


run = rosrun


def is_subscriber(topic: str, subscriber_id: str) -> bool:
    """True if a node subscribes to a topic."""
    return _has(1, topic, subscriber_id)


def is_publisher(topic: str, publisher_id: str) -> bool:
    """True if a node publishes a topic."""
    return _has(0, topic, publisher_id)


def _has(kind: int, topic: str, node: str) -> bool:
    state = rosgraph.Master("/rostest").getSystemState()[kind]
    name = rosgraph.names.script_resolve_name("rostest", topic)
    return any(node in nodes for entry, nodes in state if entry == name)
