"""What a shell completes beyond words of the command line: names on the running graph, packages and types."""

import argparse
import os
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from trundle.ros import MasterProxy, Messages, RosError

_PATIENCE_S = 0.5
"""Somebody waits with a finger on the key."""


def complete(parser: argparse.ArgumentParser, command: str) -> None:
    """Tell each argument of a command where its words come from."""
    for action in parser._actions:  # argparse has no other way to its arguments
        if isinstance(action.choices, dict):
            for choice in action.choices.values():
                if isinstance(choice, argparse.ArgumentParser):
                    complete(choice, command)
        source = _SOURCES.get((command, action.dest)) or _SOURCES.get(("", action.dest))
        if source is not None:
            setattr(action, "completer", _completer(source))  # noqa: B010 - argcomplete looks for it there


def _completer(source: Callable[[], Iterable[str]]) -> Callable[..., list[str]]:
    def words(**_: Any) -> list[str]:
        try:
            return sorted(source())
        except RosError:  # no master: nothing to complete
            return []

    return words


def _state(table: int) -> set[str]:
    return {name for name, _ in _ask("getSystemState")[table]}


def _ask(method: str) -> Any:
    return MasterProxy(caller_id="/completion", timeout_s=_PATIENCE_S).call(method)


def _topics() -> set[str]:
    return _state(0) | _state(1)


def _nodes() -> set[str]:
    return {node for table in _ask("getSystemState") for _, nodes in table for node in nodes}


def _services() -> set[str]:
    return _state(2)


def _params() -> list[str]:
    return _ask("getParamNames")


def _packages() -> Iterable[str]:
    from trundle.packages import Packages

    return Packages(os.environ, start=Path.cwd()).ros_packages()


def _message_types() -> list[str]:
    return Messages().type_names()


def _service_types() -> list[str]:
    return Messages().service_names()


_SOURCES: dict[tuple[str, str], Callable[[], Iterable[str]]] = {
    ("", "topic"): _topics,
    ("", "topics"): _topics,
    ("plot", "fields"): _topics,
    ("", "node"): _nodes,
    ("", "nodes"): _nodes,
    ("", "service"): _services,
    ("", "package"): _packages,
    ("param", "name"): _params,
    ("param", "namespace"): _params,
    ("topic", "type"): _message_types,
    ("msg", "type"): _message_types,
    ("srv", "type"): _service_types,
    ("service", "type"): _service_types,
}
"""(command, argument) → words; '' for any command."""
