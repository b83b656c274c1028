"""Index of packages: which repository and branch a distribution has them from."""

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
    """Distribution that the branch is of; '' if unknown."""


class Index:
    """Packages by name."""

    def __init__(self, entries: Iterable[Entry]) -> None:
        self._by_package: dict[str, list[Entry]] = {}
        for entry in entries:
            for package in entry.packages:
                self._by_package.setdefault(package, []).append(entry)

    def find(self, package: str, distro: str) -> Checkout | None:
        """Return where a package is for a distribution, else for the nearest that has it; None if nowhere."""
        entries = self._by_package.get(package, [])
        for each in nearest_distros(distro):
            for url, branches, _ in entries:
                if each in branches:
                    return Checkout(url, branches[each], each)
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
    found = shipped_index().find(package, "noetic")
    return "" if found is None else f"; it is published at {found.url.removesuffix('.git')}"
