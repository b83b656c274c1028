"""Index of packages: repository and branch in each distribution."""

from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import NamedTuple

from .entry import Entry, nearest_distros
from .table import read_table

_TABLES = ("rosdistro.tsv", "unreleased.tsv")
"""Released packages, and well-known ones that no distribution released."""


class Checkout(NamedTuple):
    """Repository and branch to fetch."""

    url: str
    branch: str
    """'': the default branch."""
    distro: str
    """Distribution of the branch; '' if unknown."""


class Index:
    """Packages by name."""

    def __init__(self, entries: Iterable[Entry]) -> None:
        self._by_package: dict[str, list[Entry]] = {}
        for entry in entries:
            for package in entry.packages:
                self._by_package.setdefault(package, []).append(entry)

    def find(self, package: str, distro: str) -> Checkout | None:
        """Return a package's repository for a distribution, else for the nearest one that has it, else None."""
        entries = self._by_package.get(package, [])
        for candidate in nearest_distros(distro):
            for url, branches, _ in entries:
                if candidate in branches:
                    return Checkout(url, branches[candidate], candidate)
        return Checkout(entries[0].url, "", "") if entries else None

    def names(self) -> list[str]:
        """Return the names of all packages."""
        return sorted(self._by_package)


@cache
def shipped_index() -> Index:
    """Return the index that comes with Trundle."""
    folder = Path(__file__).parent
    return Index(entry for name in _TABLES for entry in read_table((folder / name).read_text()))


def repository_hint(package: str) -> str:
    """Return '; it is published at …' for a missing package, or nothing."""
    checkout = shipped_index().find(package, "noetic")
    return "" if checkout is None else f"; it is published at {checkout.url.removesuffix('.git')}"
