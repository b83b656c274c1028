"""What `trundle launch` was asked for: which files, with which arguments."""

import sys
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TextIO

from trundle.diagnostics import UsageError
from trundle.packages import Packages


@dataclass(frozen=True, slots=True, kw_only=True)
class LaunchRequest:
    """Launch files and the `name:=value` of the command line."""

    files: tuple[Path, ...] = ()
    arguments: dict[str, str] = field(default_factory=dict[str, str])
    texts: tuple[tuple[str, str], ...] = ()
    """(name, XML) of what came in on standard input."""
    namespace: str = ""
    """`__ns:=`, which everything is put in; empty: not said."""


def read_words(words: Sequence[str], packages: Packages, *, stdin: TextIO = sys.stdin) -> LaunchRequest:
    """Tell `PKG FILE` from `FILE…`, as roslaunch does: a first word that is a file is one; `-` is standard input.

    Raises:
        UsageError: no such file or package, with what there is instead.
    """
    arguments: dict[str, str] = {}
    special: dict[str, str] = {}
    rest: list[str] = []
    for word in words:
        name, assigned, value = word.partition(":=")
        if assigned:
            if name and value:  # roslaunch does not hear an empty one: the file's default holds
                (special if name.startswith("__") else arguments)[name] = value
        else:
            rest.append(word)
    if not rest:
        raise UsageError("no launch file; say PKG FILE or a path, such as: trundle launch robot.launch")
    if rest[0] == "-" or Path(rest[0]).is_file():
        files = [word for word in rest if word != "-"]
        missing = [word for word in files if not Path(word).is_file()]
        if missing:
            raise UsageError(f"no such file: {', '.join(missing)}")
        if len(rest) - len(files) > 1:
            raise UsageError("standard input ('-') can be read only once")
        texts = (("<stdin>", stdin.read()),) if "-" in rest else ()
        found = tuple(Path(word) for word in files)
        return LaunchRequest(files=found, arguments=arguments, texts=texts, namespace=special.get("__ns", ""))
    if len(rest) == 1:
        raise UsageError(f"no such file: {rest[0]}")
    package = packages.find_package(rest[0])
    if package is None:
        raise UsageError(f"{packages.why_not_found(rest[0])}; {rest[0]!r} is no file either")
    found = tuple(_in_package(package, rest[0], word) for word in rest[1:])
    return LaunchRequest(files=found, arguments=arguments, namespace=special.get("__ns", ""))


def _in_package(folder: Path, package: str, name: str) -> Path:
    if (folder / name).is_file():
        return folder / name
    found = sorted(path for path in folder.rglob(Path(name).name) if path.is_file() and path.match(name))
    if found:
        return found[0]
    there = sorted(path.name for path in folder.rglob("*.launch"))
    raise UsageError(f"package {package!r} ({folder}) has no {name}; launch files there: {', '.join(there) or 'none'}")
