"""What `trundle launch` was asked for: which files, with which arguments."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from trundle.diagnostics import UsageError
from trundle.packages import Packages


@dataclass(frozen=True, slots=True, kw_only=True)
class LaunchRequest:
    """Launch files and the `name:=value` of the command line."""

    files: tuple[Path, ...]
    arguments: dict[str, str]


def read_words(words: Sequence[str], packages: Packages) -> LaunchRequest:
    """Tell `PKG FILE` from `FILE…`, as roslaunch does: a first word that is a file is one.

    Raises:
        UsageError: no such file or package, with what there is instead.
    """
    arguments: dict[str, str] = {}
    rest: list[str] = []
    for word in words:
        name, assigned, value = word.partition(":=")
        if assigned:
            if name and value:  # roslaunch does not hear an empty one: the file's default holds
                arguments[name] = value
        else:
            rest.append(word)
    if not rest:
        raise UsageError("no launch file; say PKG FILE or a path, such as: trundle launch robot.launch")
    if Path(rest[0]).is_file():
        missing = [word for word in rest if not Path(word).is_file()]
        if missing:
            raise UsageError(f"no such file: {', '.join(missing)}")
        return LaunchRequest(files=tuple(Path(word) for word in rest), arguments=arguments)
    if len(rest) == 1:
        raise UsageError(f"no such file: {rest[0]}")
    package = packages.find_package(rest[0])
    if package is None:
        raise UsageError(f"{packages.why_not_found(rest[0])}; {rest[0]!r} is no file either")
    return LaunchRequest(files=tuple(_in_package(package, rest[0], word) for word in rest[1:]), arguments=arguments)


def _in_package(folder: Path, package: str, name: str) -> Path:
    if (folder / name).is_file():
        return folder / name
    found = sorted(path for path in folder.rglob(Path(name).name) if path.is_file() and path.match(name))
    if found:
        return found[0]
    there = sorted(path.name for path in folder.rglob("*.launch"))
    raise UsageError(f"package {package!r} ({folder}) has no {name}; launch files there: {', '.join(there) or 'none'}")
