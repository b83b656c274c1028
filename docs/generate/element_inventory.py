"""Which elements and attributes the readers ask a file with every element for."""

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
_IN_STATE = ("model", "link", "joint", "light")
"""Elements of which a <state> has others than a world."""
_VERSIONS = ("1.3", "1.6", "1.12")
"""Versions of SDF, each with elements that the others do not have."""
_NAME_READERS = {"robots/description/sdf/required.py"}
"""Also reads the names of elements that are not supported."""
HERE = Path(__file__).parent


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


def read_inventory(probe: Path) -> Inventory:
    """Read the probe and record the elements that are read."""
    inventory, report = Inventory(), Diagnostics()

    def read() -> None:
        text, packages = probe.read_text(), Packages({}, start=probe)
        for version in _VERSIONS:
            text = re.sub(r'<sdf version="[^"]+"', f'<sdf version="{version}"', text)
            load_text(text, name=probe.name, folder=probe.parent, packages=packages, report=report)
        if probe.suffix == ".sdf":
            light = f'<sdf version="{version}"><light name="l" type="point"/></sdf>'
            load_text(light, name=probe.name, folder=probe.parent, packages=packages, report=report)

    read()  # imports the readers
    with _recording(inventory):
        read()
    for match in filter(None, (_UNUSED.fullmatch(finding.what) for finding in report.findings)):
        for parent, children in inventory.children.items():
            if _WARNING_READERS & children.get(match["tag"], set()):
                inventory.ignored.setdefault((parent, match["tag"]), match["reason"])
    return inventory


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
    if node.tag in _IN_STATE and any(ancestor.tag == "state" for ancestor in node._element.iterancestors()):
        return f"state/{node.tag}"
    return f"{parent.tag}/{node.tag}" if node.tag in _AMBIGUOUS_TAGS and parent is not None else node.tag
