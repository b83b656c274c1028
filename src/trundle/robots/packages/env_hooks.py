"""Environment variables that packages set by catkin's environment hooks, as `source devel/setup.bash` does.

No hook is run: assignments of plain text are read, of variables that have the first word of the package's name.
"""

import os
import re
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from trundle.base.files import read_text

_FOLDER = "env-hooks"
_ENDINGS = (".sh", ".sh.in", ".sh.em", ".bash", ".bash.in", ".bash.em")
_ASSIGNED = re.compile(
    r"""^\s*(?: : \s+ "?\$\{(?P<default>\w+):?=(?P<first>(?:[^{}\n]|\$\{\w+\})*)\}"?
              | (?:export\s+)?(?P<name>\w+)=(?P<value>[^\n]*) )""",
    re.MULTILINE | re.VERBOSE,
)
_COMMENT = re.compile(r"(?:^|\s)#.*$")
_FIND = re.compile(r"`rospack\s+find\s+([\w-]+)`|\$\(rospack\s+find\s+([\w-]+)\)")
_OWN_FOLDER = re.compile(r"@\(?(?:PROJECT_SOURCE_DIR|CMAKE_CURRENT_SOURCE_DIR)\)?@?")
_USED = re.compile(r"\$\{(\w+)\}|\$(\w+)")
_NOT_PLAIN = re.compile(r"[`$@;&|<>\\]")
_RESERVED = re.compile(r"(?:ROS|RMW|LD|DYLD|PYTHON|TRUNDLE|GAZEBO|CATKIN|CMAKE|GIT|XDG)(?:_|\d*$)")
"""Variables of programs themselves, whatever a package is called."""
_MAX_HOOKS, _MAX_BYTES = 20, 100_000


def hook_variables(
    package: str, folder: Path, find: Callable[[str], Path | None], environment: Mapping[str, str]
) -> dict[str, str]:
    """Return the variables that a package's hooks set, and that an environment lacks.

    Args:
        package: package's name; variables that begin with its `hook_prefix` are read.
        folder: the package's.
        find: returns the folder of a package that a hook asks rospack for.
        environment: of the user; its variables win.
    """
    prefix = hook_prefix(package)
    found: dict[str, str] = {}
    for text in _hooks(folder / _FOLDER):
        for match in _ASSIGNED.finditer(text):
            name, value = match["default"] or match["name"], match["first"] or match["value"] or ""
            if not name.startswith(prefix) or _RESERVED.match(name) or name in found or name in environment:
                continue
            plain = _plain(value, folder, find, {**environment, **found})
            if plain is not None:
                found[name] = plain
    return found


def hook_prefix(package: str) -> str:
    """Return the beginning of the variables of a package's hooks: TURTLEBOT_ for turtlebot_gazebo."""
    return f"{re.split('[_-]', package)[0].upper()}_"


def _hooks(folder: Path) -> Iterator[str]:
    try:
        names = sorted(name for name in os.listdir(folder) if name.endswith(_ENDINGS))
    except OSError:
        return
    for name in names[:_MAX_HOOKS]:
        try:
            yield read_text(folder / name, max_bytes=_MAX_BYTES)
        except OSError:
            continue


def _plain(value: str, own: Path, find: Callable[[str], Path | None], known: Mapping[str, str]) -> str | None:
    """Return a value without quotes, commands and variables; None if it has others than are understood."""

    def folder(match: re.Match[str]) -> str:
        return str(find(match[1] or match[2]) or match[0])

    text = _COMMENT.sub("", value).strip()
    if text[:1] in ("'", '"') and text[-1:] == text[:1]:
        text = text[1:-1]
    text = _OWN_FOLDER.sub(lambda _: str(own), _FIND.sub(folder, text))
    text = _USED.sub(lambda match: known.get(match[1] or match[2], match[0]), text)
    return None if _NOT_PLAIN.search(text) else text
