"""Files and arguments of a `trundle launch` command line."""

import os
import sys
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from trundle.base.diagnostics import UsageError, did_you_mean, similar_file
from trundle.base.files import is_stream, read_standard_input, read_stream
from trundle.robots.packages import Packages


@dataclass(frozen=True, slots=True, kw_only=True)
class LaunchRequest:
    """Launch files and `name:=value` arguments of the command line."""

    files: tuple[Path, ...] = ()
    arguments: dict[str, str] = field(default_factory=dict[str, str])
    texts: tuple[tuple[str, str], ...] = ()
    """Standard input and pipes as (name, XML)."""
    namespace: str = ""
    """`__ns:=`, the namespace of all nodes; empty: not given."""


def read_request(words: Sequence[str], packages: Packages) -> LaunchRequest:
    """Read `PKG FILE` or `FILE…`, as roslaunch does: `FILE…` if the first word is a file; `-` is standard input.

    Raises:
        UsageError: no such file or package; the message lists the existing ones.
    """
    arguments: dict[str, str] = {}
    special: dict[str, str] = {}
    rest: list[str] = []
    for word in words:
        name, assigned, value = word.partition(":=")
        if assigned:
            if name and value:  # roslaunch ignores an empty value: the file's default holds
                (special if name.startswith("__") else arguments)[name] = value
        else:
            rest.append(word)
    if not rest:
        raise UsageError("no launch file; name PKG FILE or a path, such as: trundle launch robot.launch")
    if _is_text(rest[0]) or os.path.isfile(rest[0]):
        texts = [word for word in rest if _is_text(word)]
        files = [word for word in rest if word not in texts]
        missing = [word for word in files if not os.path.isfile(word)]
        if missing:
            raise UsageError(f"no such file: {', '.join(path + similar_file(path) for path in missing)}")
        if texts.count("-") > 1:
            raise UsageError("standard input ('-') can be read only once")
        return LaunchRequest(
            files=tuple(map(Path, files)),
            arguments=arguments,
            texts=tuple(map(_read, texts)),
            namespace=special.get("__ns", ""),
        )
    if len(rest) == 1:
        raise UsageError(f"no such file: {rest[0]}{similar_file(rest[0])}")
    package = packages.find_package(rest[0]) and packages.find_folder(rest[0])
    if package is None:
        message = f"{packages.not_found_message(rest[0])}; {rest[0]!r} is no file either"
        raise UsageError(message, missing_packages=(rest[0],))
    if (workspace := packages.workspace_of(package)) is not None:
        print(f"using the workspace {workspace}", file=sys.stderr)
    files = tuple(_in_package(package, rest[0], word) for word in rest[1:])
    return LaunchRequest(files=files, arguments=arguments, namespace=special.get("__ns", ""))


def _is_text(word: str) -> bool:
    """True if a word names standard input or a pipe."""
    return word == "-" or is_stream(word)


def _read(word: str) -> tuple[str, str]:
    """Read a pipe; return (name for messages, text).

    Raises:
        UsageError: it cannot be read.
    """
    name = "<stdin>" if word in ("-", "/dev/stdin") else "<pipe>"
    try:
        return name, (read_standard_input() if word == "-" else read_stream(word)).decode(errors="replace")
    except OSError as error:
        raise UsageError(f"{word}: {error.strerror}") from None


def _in_package(folder: Path, package: str, name: str) -> Path:
    if os.path.isfile(folder / name):
        return folder / name
    matches = sorted(path for path in folder.rglob(Path(name).name) if os.path.isfile(path) and path.match(name))
    if matches:
        return matches[0]
    launch_files = sorted(path.name for path in folder.rglob("*.launch"))
    message = f"package {package!r} ({folder}) has no {name}{did_you_mean(name, launch_files)}"
    raise UsageError(f"{message}; launch files there: {', '.join(launch_files) or 'none'}")
