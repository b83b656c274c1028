"""Missing packages of a launch."""

import re
from collections.abc import Iterable

from trundle.base.diagnostics import DescriptionError, Source
from trundle.base.xmlnode import XmlNode
from trundle.robots.repositories import repository_hint

from .packages import PackageFinder
from .plan import LaunchNode


class MissingPackageError(DescriptionError):
    """A `$(find)` of an unknown package."""

    id = "missing-package"


_PACKAGE = re.compile(r"\$\(find ([\w.-]+)\)")


def element_name(node: XmlNode) -> str:
    """Return an element's name for messages."""
    if node.tag in ("node", "test"):
        return f"the {node.tag} {node.attribute('name')!r} ({node.attribute('pkg')}/{node.attribute('type')})"
    text = node.attribute("file") or node.attribute("name") or node.attribute("ns") or ""
    name = _PACKAGE.sub(r"\1", text)
    return f"<{node.tag}> {name}".strip()


class MissingPackages:
    """Missing packages, collected by a second, tolerant reading after the first one failed."""

    def __init__(self) -> None:
        self._first_uses: dict[str, tuple[Source, str]] = {}

    def add(self, name: str, at: Source, purpose: str = "") -> None:
        """Record the first use of a package; `purpose` completes the error message."""
        self._first_uses.setdefault(name, (at, purpose))

    def add_nodes(self, nodes: Iterable[LaunchNode], packages: PackageFinder) -> None:
        """Record the missing packages of nodes."""
        for node in nodes:
            if packages.find_folder(node.package) is None:
                self.add(node.package, node.at, f" for the node {node.full_name}")

    def combined_error(self, first: MissingPackageError) -> DescriptionError:
        """Return an error that names all missing packages, the first in full."""
        others = sorted(self._first_uses.items(), key=lambda item: (item[1][0].file, item[1][0].line or 0))
        more = [
            DescriptionError(at, f"no package {name!r}{purpose}{repository_hint(name)}", "missing-package")
            for name, (at, purpose) in others
            if f"no package {name!r}" not in first.what
        ]
        names = tuple(name for name, _ in others)
        return DescriptionError(first.at, first.what, "missing-package", more=more, missing_packages=names)
