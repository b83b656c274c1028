"""Read and write the parameter server, as rosparam does."""

import argparse
import math
import os
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import UsageError
from trundle.base.files import read_input, read_standard_input
from trundle.robots.names import join_names
from trundle.ros import set_leaves

from .graph_command import global_name, master, ros_errors

if TYPE_CHECKING:
    from trundle.base.expressions import Interpreter

EXAMPLES = """
  trundle param list
  trundle param get /robot
  trundle param set /robot/rate 20
  trundle param load robot.yaml /robot
  trundle param dump robot.yaml /robot
  trundle param delete /robot/rate
"""
_SCRIPT = "rosparam"


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    add = commands.add_parser("list", help="names of all parameters")
    add.add_argument("namespace", nargs="?", default="/", help="namespace (/)")
    add.set_defaults(run=_list)
    add = commands.add_parser("get", help="value of a parameter or a namespace, as YAML")
    add.add_argument("name", help="name of the parameter")
    add.add_argument("-p", dest="pretty", action="store_true", help="easier to read, but not always YAML")
    add.add_argument("-v", dest="verbose", action="store_true", help="print each step")
    add.set_defaults(run=_get)
    add = commands.add_parser("set", help="set a parameter from YAML")
    add.add_argument("name", help="name of the parameter")
    add.add_argument("value", nargs="?", help="YAML; put -- before a negative number")
    add.add_argument("-t", "--textfile", metavar="FILE", help="the value is the text of this file")
    add.add_argument("-b", "--binfile", metavar="FILE", help="the value is the bytes of this file")
    add.add_argument("-v", dest="verbose", action="store_true", help="print each step")
    add.set_defaults(run=_set, refuse=add.error)
    add = commands.add_parser("load", help="set parameters from a YAML file")
    add.add_argument("file", help="- for standard input")
    add.add_argument("namespace", nargs="?", default="", help="namespace (the shell's)")
    add.add_argument("-v", dest="verbose", action="store_true", help="print each step")
    add.set_defaults(run=_load)
    add = commands.add_parser("dump", help="write parameters as YAML")
    add.add_argument("file", nargs="?", help="standard output by default")
    add.add_argument("namespace", nargs="?", default="", help="namespace (the shell's)")
    add.add_argument("-v", dest="verbose", action="store_true", help="print each step")
    add.set_defaults(run=_dump)
    add = commands.add_parser("delete", help="delete a parameter or a namespace")
    add.add_argument("name", help="name of the parameter")
    add.add_argument("-v", dest="verbose", action="store_true", help="print each step")
    add.set_defaults(run=_delete)


@ros_errors
def main(args: argparse.Namespace) -> int:
    """Run the subcommand."""
    return int(args.run(args))


def _list(args: argparse.Namespace) -> int:
    namespace = global_name(args.namespace, _SCRIPT).rstrip("/") + "/"
    names: list[str] = master(_SCRIPT).call("getParamNames")
    print("\n".join(name for name in sorted(names) if name.startswith(namespace)))
    return 0


def _get(args: argparse.Namespace) -> int:
    name = global_name(args.name, _SCRIPT)
    if args.verbose:
        print(f"getting parameter [{name}]")
    value = master(_SCRIPT).call("getParam", name)
    if args.pretty and isinstance(value, dict):
        _print_pretty(value, "")
    elif args.pretty and isinstance(value, str):
        print(value)
    else:
        text = _dump_yaml(value)
        print(text.removesuffix("\n...\n") if text.endswith("\n...\n") else text)
    return 0


def _set(args: argparse.Namespace) -> int:
    name = global_name(args.name, _SCRIPT)
    if args.value is args.textfile is args.binfile is None:
        args.refuse("a value is needed: YAML, -t FILE or -b FILE")
    if args.textfile is not None and args.binfile is not None:
        args.refuse("only one of -t and -b may be given")
    if args.textfile is not None:
        _set_param(name, _read(args.textfile).decode("utf-8", "replace"), args.verbose)
    elif args.binfile is not None:
        _set_param(name, _read(args.binfile), args.verbose)
    else:
        (value,) = list(_documents(args.value or "!!str", "the value")) or [""]
        set_leaves(name, value, lambda n, v: _set_param(n, v, args.verbose))
    return 0


def _load(args: argparse.Namespace) -> int:
    text = (read_standard_input() if args.file == "-" else _read(args.file)).decode("utf-8", "replace")
    if args.verbose:
        print("reading parameters from " + ("stdin" if args.file == "-" else f"[{args.file}]"))
    base_namespace = global_name(args.namespace, _SCRIPT).rstrip("/") or "/"
    loaded: list[tuple[str, Any]] = []
    for document in _documents(text, args.file):
        namespace = base_namespace
        if isinstance(document, dict) and "_ns" in document:
            namespace = join_names(base_namespace, str(document.pop("_ns")))
            if args.verbose:
                print(f"reading parameters into namespace [{namespace}]")
        loaded.append((namespace, document))
    for namespace, document in loaded:
        if namespace == "/" and not isinstance(document, dict):
            raise UsageError("global / can only be set to a dictionary")
        if args.verbose:
            set_leaves(namespace, document, _print_param)
        set_leaves(namespace, document, lambda n, v: _set_param(n, v, verbose=False))
    return 0


def _dump(args: argparse.Namespace) -> int:
    name = global_name(args.namespace, _SCRIPT)
    if args.verbose:
        print(f"dumping namespace [{args.namespace}] to file [{args.file}]")
    tree = master(_SCRIPT).call("getParam", name)
    if args.verbose:
        set_leaves(name, tree, _print_param)
    text = _dump_yaml(tree)
    if not args.file:
        sys.stdout.write(text)
    else:
        write_atomically(Path(args.file), text)
    return 0


def _delete(args: argparse.Namespace) -> int:
    name = global_name(args.name, _SCRIPT)
    if name == "/":
        master(_SCRIPT).call("setParam", "/", {})
    else:
        master(_SCRIPT).call("deleteParam", name)
    if args.verbose:
        print("deleted ENTIRE parameter server" if name == "/" else f"deleted parameter [{name}]")
    return 0


def _set_param(name: str, value: object, verbose: bool) -> None:
    try:
        master(_SCRIPT).call("setParam", name, value)
    except ValueError as error:
        raise UsageError(f"parameter {name}: {error}") from None
    if verbose:
        print(f"set parameter [{name}] to [{_plain(value)}]")


def _print_param(name: str, value: object) -> None:
    print(f"{name}={_plain(value)}")


def _plain(value: object) -> object:
    return value.decode("latin-1") if isinstance(value, bytes) else value


def _read(path: str) -> bytes:
    if not os.path.exists(path):
        raise UsageError(f"file [{path}] does not exist")
    return read_input(path)


def _print_pretty(tree: dict[str, Any], indent: str) -> None:
    for key, value in sorted(tree.items()):
        if isinstance(value, dict):
            print(f"{indent}{key}:")
            _print_pretty(value, indent + "  ")
        elif isinstance(value, str) and "\n" in value:
            print(f"{indent}{key}: |")
            for line in value.split("\n"):
                print(f"{indent}  {line}")
        elif isinstance(value, str):
            print(f"{indent}{key}: {value}")
        else:
            text = _dump_yaml(value)
            sys.stdout.write(f"{indent}{key}: {text.removesuffix('...' + chr(10))}")


def _dump_yaml(value: object) -> str:
    import yaml

    return yaml.dump(value)


def _documents(text: str, name: str) -> Iterator[Any]:
    """Parse YAML as rosparam does, with `deg(90)` and `rad(pi/2)`."""
    import yaml

    from trundle.base.expressions import Interpreter
    from trundle.base.yaml_loader import BoundedLoader

    interpreter = Interpreter()

    class Loader(BoundedLoader):
        """YAML loader with rosparam's angles; a local class, since constructors are registered per class."""

    def angle(loader: yaml.SafeLoader, node: yaml.ScalarNode) -> float:
        return _angle(str(loader.construct_scalar(node)), interpreter)

    for tag, start in (("!degrees", "deg"), ("!radians", "rad")):
        Loader.add_constructor(tag, angle)
        Loader.add_implicit_resolver(tag, re.compile(rf"^{start}\([^)]*\)$"), [start[0]])
    try:
        yield from yaml.load_all(text, Loader)
    except yaml.YAMLError as error:
        raise UsageError(f"{name} is not YAML: {error}") from None


def _angle(text: str, interpreter: "Interpreter") -> float:
    """Return the value [rad] of `deg(n)` or `rad(…)`, whose expression has numbers and names of `math`."""
    from trundle.base.expressions import MATH_NAMES

    inner = text[4:-1]
    try:
        if text.startswith("deg("):
            return math.radians(float(inner))
        return interpreter.evaluate_number(inner, MATH_NAMES)
    except Exception:  # an expression may raise anything
        raise UsageError(f"not an angle: {text!r}") from None
