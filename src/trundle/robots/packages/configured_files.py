"""Replacement of CMake's `configure_file`, which writes files such as `robot.xacro` from `robot.xacro.in`."""

import os
import re
from pathlib import Path

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import UsageError
from trundle.base.files import read_text

from .cmake import ConfiguredFile, cmake_configured

_AT = re.compile(r"@([\w/.+-]+)@")
_BOTH = re.compile(r"@([\w/.+-]+)@|\$\{([\w/.+-]+)\}")
_DEFINE = re.compile(r"^([ \t]*#[ \t]*)cmakedefine(01)?[ \t]+(\w+)(.*)$", re.MULTILINE)
_OFF = frozenset({"", "0", "OFF", "NO", "FALSE", "N", "NOTFOUND"})


def write_configured_files(folder: Path, *, replace: bool) -> list[Path]:
    """Write the files that a package's CMakeLists.txt configures in its folder; return the files written.

    Templates and outputs outside the package, hidden files, and files that cannot be written are skipped.

    Args:
        folder: package folder.
        replace: overwrite existing files with other content.
    """
    written: list[Path] = []
    root = Path(os.path.realpath(folder))
    for configured in cmake_configured(folder):
        output, template = Path(os.path.realpath(configured.output)), Path(os.path.realpath(configured.template))
        parts = output.relative_to(root).parts if output.is_relative_to(root) else (".",)
        if any(part.startswith(".") for part in parts) or not template.is_relative_to(root) or output == template:
            continue
        try:
            if _write(configured, output, replace=replace):
                written.append(configured.output)
        except (OSError, UsageError):  # the package is read-only
            continue
    return written


def _write(configured: ConfiguredFile, output: Path, *, replace: bool) -> bool:
    if os.path.lexists(output) and not (replace and os.path.isfile(output)):
        return False
    text = _configured_text(configured)
    if os.path.exists(output) and read_text(output) == text:
        return False
    output.parent.mkdir(parents=True, exist_ok=True)
    write_atomically(output, text)
    output.chmod(configured.template.stat().st_mode & 0o777)
    return True


def _configured_text(configured: ConfiguredFile) -> str:
    """Return a template's text with variables replaced; undefined ones are empty, as in CMake."""
    text = read_text(configured.template)
    if configured.copies:
        return text

    def value(name: str) -> str:
        return ";".join(configured.variables.get(name, []))

    def defined(match: re.Match[str]) -> str:
        is_on = value(match[3]).upper() not in _OFF
        if match[2]:
            return f"{match[1]}define {match[3]} {int(is_on)}"
        return f"{match[1]}define {match[3]}{match[4]}" if is_on else f"/* #undef {match[3]} */"

    pattern = _AT if configured.only_at else _BOTH
    return pattern.sub(lambda match: value(match[1] or match[match.re.groups]), _DEFINE.sub(defined, text))
