"""References of SDF and URDF: the elements that are read in a file with every element."""

import re
import sys
from collections.abc import Callable, Generator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from unittest.mock import patch

from trundle.base.diagnostics import Diagnostics
from trundle.base.xmlnode import XmlNode
from trundle.robots.description import load_text
from trundle.robots.description.sdf.context import Context, warn_ignored
from trundle.robots.description.urdf.gazebo_tags import GazeboTags
from trundle.robots.packages import Packages

from .markdown import cell

_UNUSED = re.compile(
    r"(.*: )?<(?P<tag>\w+)>( in <\w+>)? (?P<reason>tunes Gazebo's engines|is not supported(?=; this <visual>)); .*"
)
_WARNING_READERS = {
    "robots/description/sdf/geometry.py",
    "robots/description/sdf/joint.py",
    "robots/description/sdf/surface.py",
    "robots/description/urdf/gazebo_tags.py",
}
_AMBIGUOUS_TAGS = ("ode", "horizontal", "vertical", "pressure")
_VERSIONS = ("1.3", "1.6", "1.12")
"""Versions of SDF, each with elements that the others do not have."""
_NAME_READERS = {"robots/description/sdf/required.py"}
"""Also reads the names of elements that are not supported."""
HERE = Path(__file__).parent
_INTRO = """# {format} elements

Children and attributes that Trundle reads in each element, and the file below `src/trundle/` that reads them.
Unused elements have a reason, which `trundle check` prints as an info.
Every other element or attribute is a warning with file and line, and is ignored:
`trundle check FILE` lists them.
{more}
"""
_MORE = {
    "SDF": "Versions 1.0 to 1.12; meanings and defaults that changed depend on the file's version.\n"
    "The physical meaning of each number is in\n"
    "[decision 8](../decisions/0008-where-contacts-differ-from-ode.md).",
    "URDF": "A URDF is read by urdfdom's rules and converted to SDF like in Gazebo; the content of a\n"
    "`<gazebo>` block is SDF, see [SDF elements](sdf.md).\n"
    "Links of a fixed joint are merged, as in Gazebo.",
}


class Inventory:
    """Elements that are read: parent element → child → files; and ignored elements with the reason."""

    def __init__(self) -> None:
        self.children: dict[str, dict[str, set[str]]] = {}
        self.attributes: dict[str, dict[str, set[str]]] = {}
        self.ignored: dict[tuple[str, str], str] = {}

    def add(self, table: dict[str, dict[str, set[str]]], parent: str, name: str) -> None:
        """Record that the running file reads a child or attribute."""
        file = _reader()
        if file is not None:
            table.setdefault(parent, {}).setdefault(name, set()).add(file)

    @property
    def parents(self) -> list[str]:
        """All elements of which children or attributes were read, except for the check of names."""
        parents = {*self.children, *self.attributes} - {"package"}  # of package.xml
        tables = (self.children, self.attributes)
        return sorted(p for p in parents if any(f - _NAME_READERS for t in tables for f in t.get(p, {}).values()))


def page(kind: str) -> str:
    """Return the reference of `sdf` or `urdf`."""
    inventory = read_inventory(HERE / f"every_element.{kind}")
    sections = [_section(inventory, parent) for parent in inventory.parents]
    name = kind.upper()
    return "\n".join([_INTRO.format(format=name, more=_MORE[name]), *sections])


def read_inventory(probe: Path) -> Inventory:
    """Read the probe and record the elements that are read."""
    inventory, report = Inventory(), Diagnostics()

    def read() -> None:
        text, packages = probe.read_text(), Packages({}, start=probe)
        for version in _VERSIONS:
            text = re.sub(r'<sdf version="[^"]+"', f'<sdf version="{version}"', text)
            load_text(text, name=probe.name, folder=probe.parent, packages=packages, report=report)

    read()  # imports the readers
    with _recording(inventory):
        read()
    for match in filter(None, (_UNUSED.fullmatch(finding.what) for finding in report.findings)):
        for parent, children in inventory.children.items():
            if _WARNING_READERS & children.get(match["tag"], set()):
                inventory.ignored.setdefault((parent, match["tag"]), match["reason"])
    return inventory


def _section(inventory: Inventory, parent: str) -> str:
    by_file: dict[str, list[str]] = {}
    by_reason: dict[str, list[str]] = {}
    for name, files in sorted(inventory.attributes.get(parent, {}).items()):
        by_file.setdefault(_files(files), []).append(f"`{name}=`")
    for name, files in sorted(inventory.children.get(parent, {}).items()):
        reason = inventory.ignored.get((parent, name))
        group, key = (by_reason, reason) if reason else (by_file, _files(files))
        group.setdefault(key, []).append(f"`<{name}>`")
    title = "/".join(f"<{tag}>" for tag in parent.split("/"))
    lines = [f"- {', '.join(names)}: {files}" for files, names in by_file.items()]
    lines += [f"- not used, {', '.join(names)}: {cell(reason)}" for reason, names in by_reason.items()]
    return "\n".join([f"## {cell(title)}\n", *lines, ""])


def _files(files: set[str]) -> str:
    return ", ".join(f"`{file}`" for file in sorted(files - _NAME_READERS or files))


def _reader() -> str | None:
    """Return the innermost file of a reader on the stack, without XmlNode and the helpers of all readers."""
    frame = sys._getframe(2)
    while frame is not None:
        name = frame.f_globals.get("__name__", "")
        if name.startswith(("trundle.robots.description", "trundle.robots.robot")) and not name.endswith(
            ("context", "values")
        ):
            return f"{name.removeprefix('trundle.').replace('.', '/')}.py"
        frame = frame.f_back
    return None


@contextmanager
def _recording(inventory: Inventory) -> Generator[None]:
    def recorded(table: dict[str, dict[str, set[str]]], method: Callable[..., object]) -> Callable[..., object]:
        def call(node: XmlNode, name: str) -> object:
            inventory.add(table, _title(node), name)
            return method(node, name)

        return call

    def recorded_blocks(blocks: GazeboTags, reference: str, tag: str) -> list[XmlNode]:
        inventory.add(inventory.children, "gazebo", tag)
        return all_blocks(blocks, reference, tag)

    def recorded_warning(node: XmlNode, tags: tuple[str, ...], reason: str, context: Context) -> None:
        inventory.ignored.update({(_title(node), tag): reason for tag in tags})
        warn_ignored(node, tags, reason, context)

    all_blocks = GazeboTags._all
    readers = [module for name, module in sys.modules.items() if name.startswith("trundle.robots.description.sdf.")]
    readers = [module for module in readers if hasattr(module, "warn_ignored")]
    with ExitStack() as patches:
        for name, table in (("find", "children"), ("all", "children"), ("attribute", "attributes")):
            method = recorded(getattr(inventory, table), getattr(XmlNode, name))
            patches.enter_context(patch.object(XmlNode, name, method))
        patches.enter_context(patch.object(GazeboTags, "_all", recorded_blocks))
        for module in readers:
            patches.enter_context(patch.object(module, "warn_ignored", recorded_warning))
        yield


def _title(node: XmlNode) -> str:
    """Return the element's name, with its parent's name if several parents have such a child."""
    parent = node._element.getparent()
    return f"{parent.tag}/{node.tag}" if node.tag in _AMBIGUOUS_TAGS and parent is not None else node.tag
