"""Common parts of `trundle msg` and `trundle srv`, which print types as rosmsg and rossrv do."""

import argparse
import os
import sys
from collections.abc import Iterator
from pathlib import Path

from trundle.base.diagnostics import UsageError, did_you_mean
from trundle.robots.packages import Packages
from trundle.ros import MessageError, Messages, open_bag


def configure(parser: argparse.ArgumentParser, kind_name: str) -> None:
    """Declare the arguments.

    Args:
        parser: parser of the command.
        kind_name: "message" or "service".
    """
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name, help_ in (("show", "fields and constants of a type"), ("info", "the same as show")):
        add = commands.add_parser(name, help=help_)
        add.add_argument("type", nargs="?", help=f"{kind_name} type, with or without its package (standard input)")
        add.add_argument("-r", "--raw", action="store_true", help="the definition with comments")
        if kind_name == "message":
            add.add_argument("-b", "--bag", metavar="BAG", help="use the definition in a bag")
        add.set_defaults(run=_show, refuse=add.error)
    add = commands.add_parser("list", help=f"names of all {kind_name} types")
    add.set_defaults(run=_list)
    add = commands.add_parser("md5", help="md5 sum of a type")
    add.add_argument("type", nargs="?", help="with or without its package (standard input)")
    add.set_defaults(run=_md5)
    add = commands.add_parser("package", help=f"{kind_name} types of a package")
    add.add_argument("package", nargs="?", help="package (standard input)")
    add.add_argument("-s", dest="single_line", action="store_true", help="on one line")
    add.set_defaults(run=_package)
    add = commands.add_parser("packages", help=f"packages that have {kind_name} types")
    add.add_argument("-s", dest="single_line", action="store_true", help="on one line")
    add.set_defaults(run=_packages)


def run(args: argparse.Namespace, kind_name: str) -> int:
    """Run the subcommand for messages or services."""
    return int(args.run(args, _Types(kind_name)))


class _Types:
    """Message types or service types, with the same interface."""

    def __init__(self, kind_name: str, *, definition: tuple[str, str] | None = None) -> None:
        self.kind_name = kind_name
        self._messages = Messages(bare=definition is not None)
        if definition is not None:
            self._messages.add_definition(*definition)
        self._is_service = kind_name == "service"

    def names(self) -> list[str]:
        """Return the names of all types."""
        return self._messages.service_names() if self._is_service else self._messages.type_names()

    def full_names(self, name: str) -> list[str]:
        """Return the full names of a type written with or without its package.

        Raises:
            MessageError: no such type.
        """
        name = name.removesuffix(".srv" if self._is_service else ".msg")
        if "::" in name or "." in name:
            raise UsageError(f"invalid {self.kind_name} type {name!r}; types are written package_name/Type")
        matches = [name] if "/" in name else [full for full in self.names() if full.partition("/")[2] == name]
        if not matches:
            near = did_you_mean(name, {full.partition("/")[2] for full in self.names()})
            raise MessageError(f"no {self.kind_name} type {name!r} in any package{near}")
        return matches

    def md5(self, name: str) -> str:
        """Return the md5 sum of a type."""
        return self._messages.service(name).md5sum if self._is_service else self._messages.md5(name)

    def raw(self, name: str) -> str:
        """Return the definition as written."""
        return self._messages.service_text(name) if self._is_service else self._messages.text(name)

    def text(self, name: str) -> str:
        """Return constants and fields, with those of nested types indented below."""
        if not self._is_service:
            return "".join(self._lines(name, ""))
        kind = self._messages.service(name)
        return "".join([*self._lines(kind.request, ""), "---\n", *self._lines(kind.response, "")])

    def _lines(self, name: str, indent: str) -> Iterator[str]:
        for constant, (kind, text) in self._messages.constants(name).items():
            yield f"{indent}{kind} {constant}={text}\n"
        for field, kind in self._messages.fields(name).items():
            yield f"{indent}{kind} {field}\n"
            if "/" in kind:
                yield from self._lines(kind.partition("[")[0], indent + "  ")


def _show(args: argparse.Namespace, types: _Types) -> int:
    name = args.type or _read_name()
    if getattr(args, "bag", None):
        return _show_from_bag(args.bag, name, raw=args.raw)
    try:
        names = types.full_names(name)
    except UsageError as error:
        return args.refuse(str(error))
    for full_name in names:
        if "/" not in name:
            print(f"[{full_name}]:")
        print(types.raw(full_name) if args.raw else types.text(full_name))
    return 0


def _show_from_bag(path: str, name: str, *, raw: bool) -> int:
    with open_bag(Path(path)) as bag:
        definition = next((c.definition for c in bag.connections if c.type == name), None)
    if definition is None:
        raise MessageError(f"no messages of type {name!r} in {path}")
    print(definition if raw else _Types("message", definition=(name, definition)).text(name))
    return 0


def _md5(args: argparse.Namespace, types: _Types) -> int:
    name = args.type or _read_name()
    for full_name in types.full_names(name):
        print(types.md5(full_name) if "/" in name else f"[{full_name}]: {types.md5(full_name)}")
    return 0


def _list(_: argparse.Namespace, types: _Types) -> int:
    print("\n".join(types.names()))
    return 0


def _package(args: argparse.Namespace, types: _Types) -> int:
    package = args.package or _read_name()
    names = [name for name in types.names() if name.startswith(f"{package}/")]
    if not names and Packages(os.environ, start=Path.cwd()).find_package(package) is None:
        raise UsageError(f"no {types.kind_name} types of a package {package!r}")
    print((" " if args.single_line else "\n").join(names))
    return 0


def _packages(args: argparse.Namespace, types: _Types) -> int:
    packages = dict.fromkeys(name.partition("/")[0] for name in types.names())
    print((" " if args.single_line else "\n").join(packages))
    return 0


def _read_name() -> str:
    """Return the first non-empty line of standard input."""
    for line in sys.stdin:
        if line.strip():
            return line.strip()
    raise UsageError("name a type, as an argument or on standard input")
