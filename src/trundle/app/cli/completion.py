"""Shell completion of names on the running graph, packages and types."""

import argparse
import os
from collections.abc import Callable, Iterable
from contextlib import suppress
from pathlib import Path
from typing import Any

from trundle.robots.names import anonymous_name
from trundle.ros import MasterProxy, Messages, RosError, uri_host

_TIMEOUT_S = 0.5
"""Timeout of queries to the graph [s], for which the user waits."""
_FRAMES_S = 5.0
"""Timeout for the first transform [s]."""


def complete(parser: argparse.ArgumentParser, command: str) -> None:
    """Attach a completer to each argument of a command."""
    for action in parser._actions:  # argparse has no public access to its arguments
        if isinstance(action.choices, dict):
            for choice in action.choices.values():
                if isinstance(choice, argparse.ArgumentParser):
                    complete(choice, command)
        source = _SOURCES.get((command, action.dest)) or _SOURCES.get(("", action.dest))
        completer = _COMPLETERS.get((command, action.dest)) or (source and _completer(source))
        if completer:
            setattr(action, "completer", completer)  # noqa: B010 - argcomplete reads this attribute


def _completer(source: Callable[[], Iterable[str]]) -> Callable[..., list[str]]:
    def words(**_: Any) -> list[str]:
        try:
            return sorted(source())
        except RosError:  # without a master there are no completions
            return []

    return words


def _state(table: int) -> set[str]:
    return {name for name, _ in _call_master("getSystemState")[table]}


def _call_master(method: str) -> Any:
    return MasterProxy(caller_id="/completion", timeout_s=_TIMEOUT_S).call(method)


def _findings() -> Iterable[str]:
    from trundle.base.explanations import explanations

    return explanations()


def _topics() -> set[str]:
    return _state(0) | _state(1)


def _nodes() -> set[str]:
    return {node for table in _call_master("getSystemState") for _, nodes in table for node in nodes}


def _machines() -> set[str]:
    proxy = MasterProxy(caller_id="/completion", timeout_s=_TIMEOUT_S)
    hosts = {uri_host(str(proxy.call("lookupNode", node))) for node in _nodes()}
    return {host for host in hosts if host}


def _frames() -> set[str]:
    """Return the frames received within a short time; frames published more rarely are missing."""
    import asyncio

    from trundle.ros import GraphLoop, Node, TransformListener

    if not _state(0) & {"/tf", "/tf_static"}:
        return set()
    with GraphLoop() as loop:
        node = Node(anonymous_name("completion"), loop=loop, rosout=False)
        listener = TransformListener(node)

        async def frames() -> set[str]:
            await node.wait_connected()
            await asyncio.sleep(_TIMEOUT_S)
            while not listener.buffer.frames():
                await asyncio.sleep(_TIMEOUT_S)
            return set(listener.buffer.frames())

        with suppress(TimeoutError):
            return loop.run(frames(), _FRAMES_S)
    return set()


def _services() -> set[str]:
    return _state(2)


def _params() -> list[str]:
    return _call_master("getParamNames")


def _packages() -> Iterable[str]:
    from trundle.robots.packages import Packages

    return Packages(os.environ, start=Path.cwd()).ros_packages()


def _message_types() -> list[str]:
    return Messages().type_names()


def _service_types() -> list[str]:
    return Messages().service_names()


def _message_packages() -> set[str]:
    return {name.partition("/")[0] for name in Messages().type_names()}


def _service_packages() -> set[str]:
    return {name.partition("/")[0] for name in Messages().service_names()}


def _topic_type(parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """Return the type of the topic if known, else all message types."""
    try:
        types: dict[str, str] = dict(_call_master("getTopicTypes"))
    except RosError:
        types = {}
    known = types.get(str(getattr(parsed_args, "topic", "")))
    return sorted(_message_types()) if known is None else [known]


def _programs(parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    from trundle.gazebo.nodes import program_names
    from trundle.robots.packages import Packages

    packages = Packages(os.environ, start=Path.cwd())
    return sorted(program_names(parsed_args.package, packages.find_package(parsed_args.package), env=os.environ))


def _launch_words(parsed_args: argparse.Namespace, prefix: str, **_: Any) -> list[str]:
    """Return packages and files; after a package, its launch files."""
    from argcomplete.completers import FilesCompleter

    from trundle.robots.packages import Packages

    packages = Packages(os.environ, start=Path.cwd())
    typed_words: list[str] = list(parsed_args.words or [])
    folder = packages.find_package(typed_words[0]) if typed_words else None
    if folder is not None:
        return sorted({path.name for path in folder.rglob("*.launch")})
    return [*FilesCompleter(("launch", "test", "xml"))(prefix), *sorted(packages.ros_packages())]


def _sweep_words(parsed_args: argparse.Namespace, prefix: str, **_: Any) -> list[str]:
    """Return plans, and as the first word also `report`."""
    from argcomplete.completers import FilesCompleter

    plans = list(FilesCompleter(("yaml", "yml"))(prefix))
    return plans if parsed_args.words else ["report", *plans]


def _descriptions(prefix: str, **_: Any) -> list[str]:
    """Return files, models of the model path, and shipped worlds."""
    from argcomplete.completers import FilesCompleter

    from trundle.robots.packages import Packages

    packages = Packages(os.environ, start=Path.cwd())
    models = [f"model://{name}" for name in packages.models()] if prefix.startswith("model") else []
    worlds = [name for name in packages.worlds() if prefix and name.startswith(prefix)]
    return [*FilesCompleter()(prefix), *models, *worlds]


def _rule_files(prefix: str, **_: Any) -> list[str]:
    from argcomplete.completers import FilesCompleter

    return list(FilesCompleter(("bmr",))(prefix))


_SOURCES: dict[tuple[str, str], Callable[[], Iterable[str]]] = {
    ("", "topic"): _topics,
    ("explain", "id"): _findings,
    ("", "topics"): _topics,
    ("plot", "fields"): _topics,
    ("", "node"): _nodes,
    ("", "nodes"): _nodes,
    ("", "service"): _services,
    ("", "package"): _packages,
    ("node", "machine"): _machines,
    ("tf", "source"): _frames,
    ("tf", "target"): _frames,
    ("tf", "frames"): _frames,
    ("msg", "package"): _message_packages,
    ("srv", "package"): _service_packages,
    ("param", "name"): _params,
    ("param", "namespace"): _params,
    ("topic", "type"): _message_types,
    ("msg", "type"): _message_types,
    ("srv", "type"): _service_types,
    ("service", "type"): _service_types,
}
"""(command, argument) → completions; '' for any command."""
_COMPLETERS: dict[tuple[str, str], Callable[..., list[str]]] = {
    ("bag", "genrules"): _rule_files,
    ("bag", "rules"): _rule_files,
    ("check", "file"): _descriptions,
    ("convert", "file"): _descriptions,
    ("exec", "executable"): _programs,
    ("launch", "words"): _launch_words,
    ("render", "file"): _descriptions,
    ("run", "file"): _descriptions,
    ("sweep", "words"): _sweep_words,
    ("topic", "type"): _topic_type,
}
"""(command, argument) → completions that depend on earlier arguments or the prefix."""
