"""Fetching of packages' repositories and, recursively, of their dependencies'."""

import os
import re
import shutil
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import urlsplit

from trundle.base.diagnostics import TrundleError, UsageError
from trundle.base.files import read_text
from trundle.robots.packages import Packages, run_dependencies
from trundle.robots.repositories import Checkout, Index, nearest_distros

from .git import NoBranchError, branches, checkout, remove_outside_links
from .plan import FetchPlan, plan_fetch

_LICENCE = re.compile(r"<license[^>]*>\s*([^<]*?)\s*</license>")
_AMENT_BUILD = re.compile(r"<build_type>\s*ament_\w+\s*</build_type>")
_CATKIN_BUILD = re.compile(r"<build_type[^>]*>\s*catkin\s*</build_type>|<buildtool_depend[^>]*>\s*catkin\s*<")


@dataclass(slots=True, kw_only=True)
class FetchResult:
    """Result of a fetch; each list is in the order of the names."""

    folders: list[Path] = field(default_factory=list[Path])
    """Folders of the fetched repositories."""
    built_in: list[str] = field(default_factory=list[str])
    python_libraries: list[str] = field(default_factory=list[str])
    unknown: list[str] = field(default_factory=list[str])
    errors: list[str] = field(default_factory=list[str])
    """Messages about repositories that were not fetched."""


class Fetcher:
    """Fetcher of repositories into one folder."""

    def __init__(
        self,
        *,
        index: Index,
        distro: str,
        folder: Path,
        environment: Mapping[str, str],
        log: Callable[[str], None],
        shows_progress: bool = False,
    ) -> None:
        """Create a fetcher.

        Args:
            index: index of published packages.
            distro: preferred distribution.
            folder: root folder; each repository is at OWNER/NAME below it.
            environment: environment with the search paths of packages.
            log: receives a line for each repository.
            shows_progress: True to print git's progress to stderr.
        """
        self._index = index
        self._distro = distro
        self._folder = folder
        self._log = log
        self._shows_progress = shows_progress
        path = environment.get("ROS_PACKAGE_PATH", "")
        self._environment = {**environment, "ROS_PACKAGE_PATH": os.pathsep.join(filter(None, [path, str(folder)]))}

    def plan(self, names: Iterable[str], *, for_files: bool = False) -> FetchPlan:
        """Sort package names by source; `for_files` as in `plan_fetch`."""
        packages = self._packages()
        return plan_fetch(names, packages=packages, index=self._index, distro=self._distro, for_files=for_files)

    def fetch(self, names: Iterable[str], *, for_files: bool = False) -> FetchResult:
        """Fetch packages and their run dependencies; a repository that fails does not stop the others.

        Args:
            names: package names.
            for_files: as in `plan_fetch`, for these packages only; stand-ins serve as dependencies.
        """
        result = FetchResult()
        requested: set[str] = set()
        pending = list(dict.fromkeys(names))
        while pending:
            requested.update(pending)
            plan = self.plan(pending, for_files=for_files)
            for_files = False
            result.built_in += plan.built_in
            result.python_libraries += plan.python_libraries
            result.unknown += plan.unknown
            for repository, needed in plan.checkouts.items():
                self._fetch_one(repository, needed, result)
            packages = self._packages()
            available = [*plan.present, *(name for needed in plan.checkouts.values() for name in needed)]
            dependencies = [dependency for name in available for dependency in _needs(packages, name)]
            pending = [dependency for dependency in dict.fromkeys(dependencies) if dependency not in requested]
        for names_ in (result.built_in, result.python_libraries, result.unknown):
            names_[:] = dict.fromkeys(names_)
        return result

    def fetch_repository(self, repository: Checkout, folder: Path) -> None:
        """Fetch a repository into a folder, from a branch for ROS 1.

        Raises:
            UsageError: the repository cannot be fetched, or the folder exists.
        """
        if os.path.lexists(folder):
            raise UsageError(f"{folder} is there already; remove it to fetch {repository.url} again")
        branch = repository.branch
        try:
            commit = self._checkout(repository.url, branch, folder)
        except NoBranchError:
            branch = self._ros1_branch(repository.url) or ""
            commit = self._checkout(repository.url, branch, folder)
        if _is_for_ros2(folder) and (other := self._ros1_branch(repository.url)):
            self._log(f"{_shown(repository.url)}: {branch or 'its default branch'} is for ROS 2")
            branch = other
            shutil.rmtree(folder)
            commit = self._checkout(repository.url, branch, folder)
        self._log(
            f"{_shown(repository.url)}: {branch or 'its default branch'}, commit {commit[:10]}, {_summary(folder)}"
        )
        for link in remove_outside_links(folder):
            self._log(f"  removed the link {link.relative_to(folder)}, which leads out of the repository")
        if os.path.isfile(folder / ".gitmodules"):
            self._log("  its submodules are not fetched")

    def _fetch_one(self, repository: Checkout, needed: list[str], result: FetchResult) -> None:
        folder = checkout_folder(repository.url, self._folder)
        try:
            self.fetch_repository(repository, folder)
        except TrundleError as error:
            result.errors.append(f"{', '.join(needed)}: {error}")
            return
        result.folders.append(folder)
        packages = self._packages()
        missing = [name for name in needed if packages.find_package(name) is None]
        result.errors += [f"{name}: {_shown(repository.url)} does not hold it at this branch" for name in missing]

    def _checkout(self, url: str, branch: str, folder: Path) -> str:
        return checkout(url, branch, folder, shows_progress=self._shows_progress)

    def _ros1_branch(self, url: str) -> str | None:
        """Return the branch named after the nearest distribution of ROS 1, or None."""
        names = branches(url)
        candidates = [f"{distro}{suffix}" for distro in nearest_distros(self._distro) for suffix in ("-devel", "")]
        return next((name for name in (*candidates, "ros1") if name in names), None)

    def _packages(self) -> Packages:
        return Packages(self._environment, start=self._folder)


def checkout_folder(url: str, root: Path) -> Path:
    """Return the folder of a repository: OWNER/NAME below `root`."""
    parts = urlsplit(url).path.removesuffix(".git").strip("/").split("/")
    return root.joinpath(*(part.lstrip(".-~") or "_" for part in parts))


def _needs(packages: Packages, name: str) -> list[str]:
    folder = packages.find_package(name)
    return [] if folder is None else run_dependencies(folder)


def _is_for_ros2(folder: Path) -> bool:
    texts = [read_text(file) for file in _manifests(folder)]
    return any(map(_AMENT_BUILD.search, texts)) and not any(map(_CATKIN_BUILD.search, texts))


def _summary(folder: Path) -> str:
    """Return the licences in a repository's manifests, and its size."""
    licences = {licence for file in _manifests(folder) for licence in _LICENCE.findall(read_text(file))}
    files = (Path(parent, name) for parent, _, names in os.walk(folder) for name in names)
    size = sum(file.lstat().st_size for file in files)
    return f"licence {', '.join(sorted(licences)) or 'not named'}, {size / 1e6:.1f} MB"


def _manifests(folder: Path) -> list[Path]:
    return [Path(parent, "package.xml") for parent, _, names in os.walk(folder) if "package.xml" in names]


def _shown(url: str) -> str:
    return url.removesuffix(".git")
