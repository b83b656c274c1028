"""Options, prompts and output of commands that fetch packages."""

import argparse
import os
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from trundle.base.diagnostics import UsageError
from trundle.robots.repositories import ROSDISTROS

from .prompt import confirm

if TYPE_CHECKING:
    from trundle.robots.checkouts import Fetcher, FetchPlan, FetchResult


_LISTS = tuple(f"{depth}*.{ending}" for ending in ("repos", "rosinstall") for depth in ("", "*/", "*/*/"))
"""Patterns of the files that list repositories, in a repository or beside it."""
_MAX_LISTS = 5


def add_fetch_options(parser: argparse.ArgumentParser) -> None:
    """Declare the options of commands that fetch."""
    add = parser.add_argument
    add("-y", "--yes", "--default-yes", action="store_true", help="do not ask before fetching")
    add(
        "--distro",
        "--rosdistro",
        choices=ROSDISTROS,
        default=_distro(),
        help="whose branches are fetched (%(default)s)",
    )
    add(
        "--index", metavar="URL|FILE", help="distribution.yaml or index-v4.yaml, in place of the index that is built in"
    )
    add("--into", type=Path, metavar="DIR", help="folder for the repositories (one of the user's data, searched last)")


def _distro() -> str:
    distro = os.environ.get("ROS_DISTRO", "")
    return distro if distro in ROSDISTROS else "noetic"


def defaults() -> dict[str, Any]:
    """Return the default options."""
    return {"yes": False, "distro": _distro(), "index": None, "into": None}


def make_fetcher(args: argparse.Namespace) -> "Fetcher":
    """Return a fetcher with the options that `add_fetch_options` declared.

    Raises:
        TrundleError: the index cannot be read.
    """
    from trundle.robots.checkouts import Fetcher
    from trundle.robots.repositories import read_index, shipped_index

    index = read_index(args.index, args.distro) if args.index else shipped_index()
    return Fetcher(
        index=index,
        distro=args.distro,
        folder=fetch_folder(args),
        environment=os.environ,
        log=_log,
        shows_progress=sys.stderr.isatty(),
    )


def fetch_folder(args: argparse.Namespace) -> Path:
    """Return the folder of `--into`, else the user's."""
    from trundle.robots.packages import fetched_folder

    return fetched_folder(os.environ) if args.into is None else args.into.expanduser().absolute()


def fetch_packages(names: Iterable[str], args: argparse.Namespace, *, for_files: bool = False) -> int:
    """Print the plan, ask, fetch, and print the remaining manual steps; return the exit code.

    Args:
        names: names of packages.
        args: options that `add_fetch_options` declared.
        for_files: True: fetch packages for their files, even if their nodes have stand-ins.

    Raises:
        UsageError: standard input is not a terminal, and -y is missing.
    """
    fetcher = make_fetcher(args)
    names = list(dict.fromkeys(names))
    plan = fetcher.plan(names, for_files=for_files)
    print_plan(plan, fetch_folder(args))
    if not plan.checkouts:
        _print_rest(plan.python_libraries, plan.unknown)
        return 0
    if not args.yes and not ask(plan):
        return 1
    result = fetcher.fetch(names, for_files=for_files)
    _print_result(result)
    return 1 if result.errors else 0


def offer(names: Sequence[str]) -> bool:
    """Name the command that fetches missing packages; on a terminal, ask and fetch. Return True if any were fetched."""
    fetcher = make_fetcher(argparse.Namespace(**defaults()))
    plan = fetcher.plan(names, for_files=True)
    published = [name for packages in plan.checkouts.values() for name in packages]
    if plan.unknown and (lists := _repository_lists()):
        print(
            f"no index has {' '.join(plan.unknown)}; lists of repositories here: {' '.join(map(str, lists))}: "
            "vcs import in trundle shell fetches what one names",
            file=sys.stderr,
        )
    if not published:
        print("--lenient leaves out what needs missing packages", file=sys.stderr)
        return False
    if not (sys.stdin.isatty() and sys.stderr.isatty()):
        print(
            f"trundle pack get {' '.join(published)} fetches them; --lenient leaves out what needs them",
            file=sys.stderr,
        )
        return False
    for checkout, packages in plan.checkouts.items():
        print(f"  {' '.join(packages)}: {checkout.url.removesuffix('.git')}", file=sys.stderr)
    if not ask(plan):
        return False
    result = fetcher.fetch(published, for_files=True)
    _print_result(result)
    return bool(result.folders)


def _repository_lists() -> list[Path]:
    """Return the .repos and .rosinstall files of the packages' folders and the workspace around the working folder."""
    from trundle.robots.packages import Packages

    folders = Packages(os.environ, start=Path.cwd()).package_folders()
    files = (file for folder in folders for pattern in _LISTS for file in sorted(folder.glob(pattern)))
    return list(dict.fromkeys(files))[:_MAX_LISTS]


def print_plan(plan: "FetchPlan", folder: Path) -> None:
    """Print the source of each package."""
    if plan.present:
        print(f"already here: {' '.join(plan.present)}")
    if plan.built_in:
        print(f"part of Trundle: {' '.join(plan.built_in)}")
    for checkout, packages in plan.checkouts.items():
        branch = checkout.branch or "its default branch"
        print(f"{checkout.url.removesuffix('.git')} ({branch}): {' '.join(packages)}")
    if plan.checkouts:
        print(f"into {folder}, with the packages that these need; they are neither run nor built")


def ask(plan: "FetchPlan") -> bool:
    """Ask on the terminal whether to fetch.

    Raises:
        UsageError: standard input is not a terminal.
    """
    if not sys.stdin.isatty():
        raise UsageError("fetching needs a confirmation; -y gives it")
    count = len(plan.checkouts)
    return confirm(f"fetch {count} {'repository' if count == 1 else 'repositories'}?")


def _print_result(result: "FetchResult") -> None:
    for error in result.errors:
        print(f"error: {error}", file=sys.stderr)
    _print_rest(result.python_libraries, result.unknown)


def _print_rest(libraries: list[str], unknown: list[str]) -> None:
    if libraries:
        print(f"Python libraries: {sys.executable} -m pip install {' '.join(dict.fromkeys(libraries))}")
    if unknown:
        print(f"system packages, if needed: {' '.join(unknown)}")


def _log(line: str) -> None:
    print(line, flush=True)
