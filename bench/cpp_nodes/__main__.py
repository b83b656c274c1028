"""Compiles the C++ of checked-out repositories by catkin_make, starts their programs, and lists which run.

    python -m bench.cpp_nodes FOLDER[,FOLDER…]… [--targets FILE] [--list FILE] [--workspaces FOLDER] [--built]

Each argument is a repository with the repositories that it needs, which become one workspace. A program starts as the
first launch file of its repository says that names it, with its parameters, arguments and remappings, on a master of
its own. It **starts** if it registers at the master, or ends by itself without an error. Messages of the topics that
it subscribes to are published (`inputs.py`); the list says on how many of its topics it publishes within ten seconds.
A plugin of Gazebo, a controller or simulated hardware **is loaded** if a launch file of its repository that names it,
or else a world or robot, loads it in a run of three simulated seconds. `--targets` is a table with the columns
repository, package and target: only those. `--built`: do not compile again.
"""

import argparse
import csv
import sys
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

from .library_run import LibraryRun
from .program_run import ProgramRun
from .workspace import Workspace

_COLUMNS = ("repository", "package", "target", "kind", "built", "starts", "does")


def main() -> int:
    """Build and start what the command line names."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", metavar="FOLDER[,FOLDER…]")
    parser.add_argument("--targets", type=Path, help="table with the columns repository, package, target")
    parser.add_argument("--list", type=Path, help="file for the table of results")
    parser.add_argument("--workspaces", type=Path, help="folder that keeps the workspaces")
    parser.add_argument("--built", action="store_true", help="start what the last build has made")
    args = parser.parse_args()
    rows: list[tuple[str, ...]] = []
    with tempfile.TemporaryDirectory() as temporary:
        for words in args.folders:
            for row in _rows(words.split(","), args.workspaces or Path(temporary), args):
                print("\t".join(row), flush=True)
                rows.append(row)
    if args.list:
        args.list.write_text("\n".join("\t".join(row) for row in [_COLUMNS, *rows]) + "\n")
    started = [row for row in rows if row[5] != "-"]
    print(f"{sum(row[4] == 'compiles' for row in rows)} of {len(rows)} targets compile")
    print(f"{sum(row[5] in ('starts', 'ends', 'is loaded') for row in started)} of {len(started)} start or are loaded")
    return 0


def _rows(folders: list[str], workspaces: Path, args: argparse.Namespace) -> Iterator[tuple[str, ...]]:
    paths = [Path(folder) for folder in folders]
    repository = paths[0].name
    workspace = Workspace(workspaces.resolve() / repository, paths)
    wanted = None if args.targets is None else _wanted(args.targets, repository)
    for target in workspace.reported() if args.built else workspace.build():
        if wanted is not None and (target.package, target.name) not in wanted:
            continue
        built = "compiles" if target.file else target.state
        started, does = "-", ""
        if target.file and target.kind == "program":
            with tempfile.TemporaryDirectory() as home:
                started, does = ProgramRun(workspace, target, home).result()
        elif target.file:
            started, does = LibraryRun(workspace, target).result()
        yield repository, target.package, target.name, target.kind, built, started, does


def _wanted(table: Path, repository: str) -> set[tuple[str, str]]:
    with table.open(newline="") as file:
        rows: Iterable[Mapping[str, str]] = csv.DictReader(file, delimiter="\t")
        return {(row["package"], row["target"]) for row in rows if row["repository"].replace("/", "+") == repository}


if __name__ == "__main__":
    sys.exit(main())
