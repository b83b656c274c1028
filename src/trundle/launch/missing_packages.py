"""Packages that a launch needs and that are not there."""

from collections.abc import Iterable

from trundle.diagnostics import DescriptionError, Source
from trundle.packages import repository_hint

from .packages import PackageFinder
from .plan import LaunchNode


class MissingPackageError(DescriptionError):
    """A `$(find)` of a package that is not there."""


class MissingPackages:
    """Those that a second reading comes across, which goes on where the first one ended."""

    def __init__(self) -> None:
        self._places: dict[str, tuple[Source, str]] = {}

    def add(self, name: str, at: Source, what_for: str = "") -> None:
        """Keep the first place that needs a package; `what_for` continues the sentence."""
        self._places.setdefault(name, (at, what_for))

    def add_nodes(self, nodes: Iterable[LaunchNode], packages: PackageFinder) -> None:
        """Add the packages of nodes, as far as they are not there."""
        for node in nodes:
            if packages.find_folder(node.package) is None:
                self.add(node.package, node.at, f" for the node {node.full_name}")

    def combined_error(self, first: MissingPackageError) -> DescriptionError:
        """The error that names them all, the first in full."""
        others = sorted(self._places.items(), key=lambda item: (item[1][0].file, item[1][0].line or 0))
        more = [
            DescriptionError(at, f"no package {name!r}{what_for}{repository_hint(name)}")
            for name, (at, what_for) in others
            if f"no package {name!r}" not in first.what
        ]
        return DescriptionError(first.at, first.what, more=more)
