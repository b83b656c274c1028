"""dynamic_reconfigure/dynparam: reads and sets options of running nodes."""

import argparse
from collections.abc import Callable, Coroutine, Mapping
from pathlib import Path
from typing import Any, cast

import yaml

from trundle.base.atomic_write import write_atomically
from trundle.base.files import read_input
from trundle.base.yaml_loader import BoundedLoader, load_yaml
from trundle.ros import Node, Options, ServiceError, find_reconfigurable, read_options, set_options

from .host import NodeHost

_PYTHON_OBJECT = "tag:yaml.org,2002:python/object/new:"


class Dynparam:
    """Executes one command; exit code 1 on failure."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del host
        self._node = node
        self._arguments = arguments

    async def run(self) -> int:
        """Execute the command."""
        try:
            args = _parser().parse_args(_shield_negative_numbers(self._arguments))
        except SystemExit as exit_:  # argparse printed the error
            return int(exit_.code or 0)
        command: Callable[[Node, argparse.Namespace], Coroutine[None, None, None]] = args.command
        try:
            if "node" in args and self._node.resolve(args.node) not in await find_reconfigurable(self._node):
                self._node.log.info(f"waiting for the options of {self._node.resolve(args.node)}")
            await command(self._node, args)
        except (ServiceError, OSError, ValueError, yaml.YAMLError) as error:
            self._node.log.error(f"dynparam: {error}")
            return 1
        return 0


async def _list(node: Node, _args: argparse.Namespace) -> None:
    for name in await find_reconfigurable(node):
        print(name)


async def _get(node: Node, args: argparse.Namespace) -> None:
    print(await _values(node, args))


async def _dump(node: Node, args: argparse.Namespace) -> None:
    write_atomically(Path(args.file), yaml.safe_dump(await _values(node, args)))


async def _set(node: Node, args: argparse.Namespace) -> None:
    if args.value is not None:
        await set_options(node, args.node, {args.parameter: args.value}, timeout_s=args.timeout)
        return
    await set_options(node, args.node, _mapping(args.parameter), timeout_s=args.timeout)


async def _load(node: Node, args: argparse.Namespace) -> None:
    values = _mapping(read_input(args.file).decode())
    options = {name: value for name, value in values.items() if name != "groups"}
    await set_options(node, args.node, options, timeout_s=args.timeout)


async def _set_from_parameters(node: Node, args: argparse.Namespace) -> None:
    values = await node.params.get("~", {})
    if not values:
        raise ServiceError(f"{node.name} has no parameters to set options from")
    await set_options(node, args.node, values, timeout_s=args.timeout)


async def _values(node: Node, args: argparse.Namespace) -> Options:
    return {option.name: option.value for option in await read_options(node, args.node, timeout_s=args.timeout)}


def _mapping(text: str) -> Mapping[str, object]:
    """Parse a YAML mapping of options, written by hand or dumped by the original.

    Raises:
        ValueError: the text is not a mapping.
    """
    value = load_yaml(text, _Loader)
    if not isinstance(value, dict):
        raise ValueError(f"options are given as NAME VALUE, or as '{{name: value}}'; {text[:60]!r} is neither")
    return {str(name): item for name, item in cast("dict[object, object]", value).items()}


class _Loader(BoundedLoader):
    """YAML loader that reads the Python object dumped by the original as a mapping."""


def _construct_dumped(loader: yaml.SafeLoader, _suffix: str, node: yaml.Node) -> Any:
    mapping = loader.construct_mapping(cast(yaml.MappingNode, node), deep=True)
    return mapping.get("dictitems", {})


_Loader.add_multi_constructor(_PYTHON_OBJECT, _construct_dumped)


def _shield_negative_numbers(arguments: list[str]) -> list[str]:
    """Protect negative numbers from argparse, which would parse them as options."""
    return [f" {argument}" if argument[:1] == "-" and argument[1:2].isdigit() else argument for argument in arguments]


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="dynparam", description="Options of running nodes.")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    for name, command, arguments, about in (
        ("list", _list, (), "nodes that have options"),
        ("get", _get, ("node",), "the options of a node"),
        ("set", _set, ("node", "parameter", "value"), "change one: NODE NAME VALUE, or several: NODE '{name: value}'"),
        ("set_from_parameters", _set_from_parameters, ("node",), "change them to this node's private parameters"),
        ("dump", _dump, ("node", "file"), "write the options of a node into a YAML file"),
        ("load", _load, ("node", "file"), "change options to those of a YAML file"),
    ):
        sub = commands.add_parser(name, help=about, description=about)
        sub.set_defaults(command=command)
        sub.add_argument("-t", "--timeout", type=float, default=None, help="seconds to wait for the node")
        for argument in arguments:
            sub.add_argument(argument, nargs="?" if argument == "value" else None)
    return parser
