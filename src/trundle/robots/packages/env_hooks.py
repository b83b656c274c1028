"""Environment variables of catkin's environment hooks, which `source devel/setup.bash` sets.

No hook is run: only plain-text assignments are read, to variables that begin with the first word of the package's name.
"""

import os
import re
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from trundle.base.files import read_text

_FOLDER = "env-hooks"
_ENDINGS = (".sh", ".sh.in", ".sh.em", ".bash", ".bash.in", ".bash.em")
_ASSIGNMENT = re.compile(
    r"""^\s*(?: : \s+ "?\$\{(?P<default>\w+):?=(?P<first>(?:[^{}\n]|\$\{\w+\})*)\}"?
              | (?:export\s+)?(?P<name>\w+)=(?P<value>[^\n]*) )""",
    re.MULTILINE | re.VERBOSE,
)
_COMMENT = re.compile(r"(?:^|\s)#.*$")
_FIND = re.compile(r"`rospack\s+find\s+([\w-]+)`|\$\(rospack\s+find\s+([\w-]+)\)")
_SOURCE_FOLDER = re.compile(r"@\(?(?:PROJECT_SOURCE_DIR|CMAKE_CURRENT_SOURCE_DIR)\)?@?")
_REFERENCE = re.compile(r"\$\{(\w+)\}|\$(\w+)")
_NOT_PLAIN = re.compile(r"[`$@;&|<>\\]")
_RESERVED = re.compile(r"(?:ROS|RMW|LD|DYLD|PYTHON|TRUNDLE|GAZEBO|CATKIN|CMAKE|GIT|XDG)(?:_|\d*$)")
"""Variables of common programs, never set for a package."""
_MAX_HOOKS, _MAX_BYTES = 20, 100_000


def hook_variables(
    package: str, folder: Path, find: Callable[[str], Path | None], environment: Mapping[str, str]
) -> dict[str, str]:
    """Return the variables that a package's hooks set and that the environment lacks.

    Args:
        package: package name; variables that begin with its `hook_prefix` are read.
        folder: package folder.
        find: returns a package's folder, as `rospack find` in a hook.
        environment: user's environment, which takes precedence.
    """
    prefix = hook_prefix(package)
    variables: dict[str, str] = {}
    for text in _hooks(folder / _FOLDER):
        for match in _ASSIGNMENT.finditer(text):
            name, value = match["default"] or match["name"], match["first"] or match["value"] or ""
            if not name.startswith(prefix) or _RESERVED.match(name) or name in variables or name in environment:
                continue
            resolved = _plain(value, folder, find, {**environment, **variables})
            if resolved is not None:
                variables[name] = resolved
    return variables


def hook_prefix(package: str) -> str:
    """Return the prefix of variables that a package's hooks may set: TURTLEBOT_ for turtlebot_gazebo."""
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


def _plain(
    value: str, package_folder: Path, find: Callable[[str], Path | None], variables: Mapping[str, str]
) -> str | None:
    """Return a value with quotes removed, commands and variables replaced; None if it has unsupported syntax."""

    def folder(match: re.Match[str]) -> str:
        return str(find(match[1] or match[2]) or match[0])

    text = _COMMENT.sub("", value).strip()
    if text[:1] in ("'", '"') and text[-1:] == text[:1]:
        text = text[1:-1]
    text = _SOURCE_FOLDER.sub(lambda _: str(package_folder), _FIND.sub(folder, text))
    text = _REFERENCE.sub(lambda match: variables.get(match[1] or match[2], match[0]), text)
    return None if _NOT_PLAIN.search(text) else text
