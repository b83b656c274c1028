"""Plan of a fetch: package names sorted by source."""

from collections.abc import Iterable
from dataclasses import dataclass, field

from trundle.robots.packages import STOCK, STOCK_WITH_FILES, Packages
from trundle.robots.repositories import Checkout, Index, python_library

from .built_in import BUILT_IN


@dataclass(frozen=True, slots=True, kw_only=True)
class FetchPlan:
    """Package names by source; each list is in the order of the names."""

    checkouts: dict[Checkout, list[str]] = field(default_factory=dict[Checkout, list[str]])
    """Repository → packages to fetch from it."""
    present: list[str] = field(default_factory=list[str])
    """Packages that already exist."""
    built_in: list[str] = field(default_factory=list[str])
    """Packages that Trundle replaces."""
    python_libraries: list[str] = field(default_factory=list[str])
    """PyPI's names."""
    unknown: list[str] = field(default_factory=list[str])
    """Names that neither the index nor PyPI has, mostly system libraries."""


def plan_fetch(
    names: Iterable[str], *, packages: Packages, index: Index, distro: str, for_files: bool = False
) -> FetchPlan:
    """Sort names of packages and system libraries, as in package.xml, by source.

    Args:
        names: names to sort.
        packages: existing packages.
        index: index of published packages.
        distro: preferred distribution.
        for_files: True to fetch packages for their files even if their nodes have stand-ins.
    """
    plan = FetchPlan()
    built_in = BUILT_IN | (STOCK - STOCK_WITH_FILES if for_files else STOCK)
    for name in dict.fromkeys(names):
        if name in built_in:
            plan.built_in.append(name)
        elif packages.find_package(name) is not None:
            plan.present.append(name)
        elif (checkout := index.find(name, distro)) is not None:
            plan.checkouts.setdefault(checkout, []).append(name)
        elif (library := python_library(name)) is not None:
            plan.python_libraries.append(library)
        else:
            plan.unknown.append(name)
    return plan
