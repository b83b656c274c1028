"""References of roslaunch and xacro: each tag and attribute, from the readers and a table of facts."""

from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from unittest.mock import patch

import xacro

from trundle.base.diagnostics import Diagnostics
from trundle.base.xmlnode import XmlNode
from trundle.robots.description import expand_xacro
from trundle.robots.launch import read_launch
from trundle.robots.launch.attributes import Attributes
from trundle.robots.packages import Packages

from .element_spec import HERE, Spec, read_spec
from .markdown import code, html, table

_ROSLAUNCH = """# roslaunch elements

Trundle reads the tags of ROS 1's launch files. Each tag also has the attributes `if` and `unless`, whose value is true
or false. A tag or an attribute that is not listed is a warning with file and line
([`unsupported-element`](diagnostics.md#unsupported-element)). Attributes may contain `$(find PACKAGE)`, `$(arg NAME)`,
`$(env VARIABLE)`, `$(optenv VARIABLE DEFAULT)`, `$(anon NAME)`, `$(dirname)`, or be one `$(eval EXPRESSION)`.
"""
_XACRO = """# xacro elements

Trundle expands xacro files with the official package, version {version}, by the names and rules of ROS Noetic;
files for ROS Indigo are read as well ([`xacro-prefix`](diagnostics.md#xacro-prefix)). Any other element with the prefix
`xacro:` calls a macro. An attribute that is not listed is an error
([`xacro`](diagnostics.md#xacro)).
"""
_HEADINGS = ("tag", "meaning", "type", "unit", "default")


def roslaunch_page() -> str:
    """Return the reference of launch files."""
    return _page(_ROSLAUNCH, "roslaunch", HERE / "every_element.launch")


def xacro_page() -> str:
    """Return the reference of xacro."""
    from importlib.metadata import version

    return _page(_XACRO.format(version=version("xacro")), "xacro", HERE / "every_element.xacro")


def _page(intro: str, kind: str, probe: Path) -> str:
    rows = read_spec(kind)
    parts = [intro]
    for section in dict.fromkeys(row.section for row in rows):
        listed = [row for row in rows if row.section == section]
        (meaning,) = [row.meaning for row in listed if not row.attribute]
        parts.append(f"## &lt;{section}&gt; {{ #{section.replace(':', '-')} }}\n")
        if meaning:
            parts.append(f"{html(meaning[0].upper() + meaning[1:])}.\n")
        cells = [_cells(row) for row in listed if row.attribute]
        if cells:
            parts.append(table(_HEADINGS, cells))
        parts.append(f"```xml\n{_line_of(section, probe)}\n```\n")
    return "\n".join(parts)


def _cells(row: Spec) -> tuple[str, ...]:
    default = code(row.default) if row.default else ""
    return (code(row.attribute), html(row.meaning), html(row.type), html(row.unit), default)


def _line_of(tag: str, probe: Path) -> str:
    """Return the lines of the probe with the first element of a tag."""
    lines = probe.read_text().splitlines()
    first = next(i for i, line in enumerate(lines) if line.lstrip().startswith((f"<{tag} ", f"<{tag}>")))
    indent = len(lines[first]) - len(lines[first].lstrip())
    block = [lines[first]]
    if not (lines[first].rstrip().endswith("/>") or f"</{tag}>" in lines[first]):
        for line in lines[first + 1 :]:
            block.append(line)
            if line.startswith(" " * indent + f"</{tag}>") or (line.rstrip().endswith("/>") and "<" not in line):
                break
    return "\n".join(line[indent:] for line in block)


def read_roslaunch_attributes() -> set[str]:
    """Return `tag@attribute` for each attribute that the readers of launch files know."""
    probe = HERE / "every_element.launch"
    known: set[str] = set()
    init = Attributes.__init__

    def recorded(self: Attributes, node: XmlNode, *rest: Any) -> None:
        known.update(f"{node.tag}@{name}" for name in rest[-1])
        init(self, node, *rest)

    with patch.object(Attributes, "__init__", recorded):
        read_launch([probe], packages=Packages({}, start=probe), report=Diagnostics(), env={}, arguments={"speed": "1"})
    return known


def read_xacro_attributes() -> set[str]:
    """Return `tag@attribute` for each attribute that xacro's package knows."""
    probe = HERE / "every_element.xacro"
    with _recorded_checks() as known:
        expand_xacro(probe, {}, packages=Packages({}, start=probe), report=Diagnostics())
    return known


@contextmanager
def _recorded_checks() -> Generator[set[str]]:
    known: set[str] = set()
    check = xacro.check_attrs

    def recorded(node: Any, required: list[str], optional: list[str]) -> Any:
        known.update(f"{node.tagName}@{name}" for name in (*required, *optional))
        return check(node, required, optional)

    with patch.object(xacro, "check_attrs", recorded):
        yield known
