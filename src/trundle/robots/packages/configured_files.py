"""Files of a package that CMake's `configure_file` would write, such as `robot.xacro` from `robot.xacro.in`."""

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
    """Write the files that a package's CMakeLists.txt configures inside its folder, and return those written.

    Templates and files outside the package, and hidden files, are left out; what cannot be written, too.

    Args:
        folder: the package's.
        replace: write again those that exist with another content.
    """
    written: list[Path] = []
    root = Path(os.path.realpath(folder))
    for each in cmake_configured(folder):
        output, template = Path(os.path.realpath(each.output)), Path(os.path.realpath(each.template))
        inside = output.relative_to(root).parts if output.is_relative_to(root) else (".",)
        if any(part.startswith(".") for part in inside) or not template.is_relative_to(root) or output == template:
            continue
        try:
            if _write(each, output, replace=replace):
                written.append(each.output)
        except (OSError, UsageError):  # a read-only package
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
    """Return a template's text with variables replaced; those not defined are empty, as in CMake."""
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
