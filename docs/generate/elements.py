"""References of SDF and URDF: the elements read from a file that has every element."""

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
    r"(.*: )?<(?P<tag>\w+)>( in <\w+>)? (?P<why>tunes Gazebo's engines|is not supported(?=; this <visual>)); .*"
)
_SAYS_SO = {
    "robots/description/sdf/geometry.py",
    "robots/description/sdf/joint.py",
    "robots/description/sdf/surface.py",
    "robots/description/urdf/gazebo_tags.py",
}
_OF_SEVERAL = ("ode", "horizontal", "vertical", "pressure")
_VERSIONS = ("1.3", "1.6", "1.12")
"""SDF's, of which each reads elements that the others do not."""
_ONLY_NAMED = {"robots/description/sdf/required.py"}
"""Reads the names of elements that are not supported, too."""
HERE = Path(__file__).parent
_INTRO = """# {format} elements

What Trundle's readers ask each element for, and the file below `src/trundle/` that reads it.
What is not used has its reason, which `trundle check` prints as an info.
Every other element or attribute is named with file and line as a warning, and left out:
`trundle check FILE` lists them, too.
{more}
"""
_MORE = {
    "SDF": "Versions 1.0 to 1.12; where a version changed a meaning or a default, the file's own version decides.\n"
    "What each number means to the physics stands in\n"
    "[decision 8](../decisions/0008-where-contacts-differ-from-ode.md).",
    "URDF": "A URDF is read by urdfdom's rules and turned into SDF as Gazebo does it; what stands in a\n"
    "`<gazebo>` block is SDF, see [SDF elements](sdf.md).\n"
    "A joint that is fixed is lumped: its links become one, as in Gazebo.",
}


class Inventory:
    """Elements read: parent element → child → files; and those read only for a warning, with its reason."""

    def __init__(self) -> None:
        self.children: dict[str, dict[str, set[str]]] = {}
        self.attributes: dict[str, dict[str, set[str]]] = {}
        self.ignored: dict[tuple[str, str], str] = {}

    def add(self, table: dict[str, dict[str, set[str]]], parent: str, name: str) -> None:
        """Note that the file that is running asks for it."""
        file = _reader()
        if file is not None:
            table.setdefault(parent, {}).setdefault(name, set()).add(file)

    @property
    def parents(self) -> list[str]:
        """Every element of which something was read, beyond the check of names."""
        every = {*self.children, *self.attributes} - {"package"}  # of package.xml
        tables = (self.children, self.attributes)
        return sorted(p for p in every if any(f - _ONLY_NAMED for t in tables for f in t.get(p, {}).values()))


def page(kind: str) -> str:
    """The reference of `sdf` or `urdf`."""
    inventory = read_inventory(HERE / f"every_element.{kind}")
    sections = [_section(inventory, parent) for parent in inventory.parents]
    name = kind.upper()
    return "\n".join([_INTRO.format(format=name, more=_MORE[name]), *sections])


def read_inventory(probe: Path) -> Inventory:
    """Read the probe and note what is asked for."""
    inventory, report = Inventory(), Diagnostics()

    def read() -> None:
        text, packages = probe.read_text(), Packages({}, start=probe)
        for version in _VERSIONS:
            text = re.sub(r'<sdf version="[^"]+"', f'<sdf version="{version}"', text)
            load_text(text, name=probe.name, folder=probe.parent, packages=packages, report=report)

    read()  # which imports the readers
    with _recording(inventory):
        read()
    for said in filter(None, (_UNUSED.fullmatch(finding.what) for finding in report.findings)):
        for parent, children in inventory.children.items():
            if _SAYS_SO & children.get(said["tag"], set()):
                inventory.ignored.setdefault((parent, said["tag"]), said["why"])
    return inventory


def _section(inventory: Inventory, parent: str) -> str:
    by_file: dict[str, list[str]] = {}
    by_reason: dict[str, list[str]] = {}
    for name, files in sorted(inventory.attributes.get(parent, {}).items()):
        by_file.setdefault(_files(files), []).append(f"`{name}=`")
    for name, files in sorted(inventory.children.get(parent, {}).items()):
        why = inventory.ignored.get((parent, name))
        group, key = (by_reason, why) if why else (by_file, _files(files))
        group.setdefault(key, []).append(f"`<{name}>`")
    title = "/".join(f"<{tag}>" for tag in parent.split("/"))
    lines = [f"- {', '.join(names)}: {where}" for where, names in by_file.items()]
    lines += [f"- not used, {', '.join(names)}: {cell(why)}" for why, names in by_reason.items()]
    return "\n".join([f"## {cell(title)}\n", *lines, ""])


def _files(files: set[str]) -> str:
    return ", ".join(f"`{file}`" for file in sorted(files - _ONLY_NAMED or files))


def _reader() -> str | None:
    """The first file of a reader on the stack, below XmlNode and the helpers that all readers share."""
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

    def asked(blocks: GazeboTags, reference: str, tag: str) -> list[XmlNode]:
        inventory.add(inventory.children, "gazebo", tag)
        return all_blocks(blocks, reference, tag)

    def noted(node: XmlNode, tags: tuple[str, ...], why: str, context: Context) -> None:
        inventory.ignored.update({(_title(node), tag): why for tag in tags})
        warn_ignored(node, tags, why, context)

    all_blocks = GazeboTags._all
    readers = [module for name, module in sys.modules.items() if name.startswith("trundle.robots.description.sdf.")]
    readers = [module for module in readers if hasattr(module, "warn_ignored")]
    with ExitStack() as patches:
        for name, table in (("find", "children"), ("all", "children"), ("attribute", "attributes")):
            method = recorded(getattr(inventory, table), getattr(XmlNode, name))
            patches.enter_context(patch.object(XmlNode, name, method))
        patches.enter_context(patch.object(GazeboTags, "_all", asked))
        for module in readers:
            patches.enter_context(patch.object(module, "warn_ignored", noted))
        yield


def _title(node: XmlNode) -> str:
    """The element's name, after its parent's where several parents have one of that name."""
    parent = node._element.getparent()
    return f"{parent.tag}/{node.tag}" if node.tag in _OF_SEVERAL and parent is not None else node.tag
