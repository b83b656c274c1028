"""Edit the list of a workspace's repositories, and fetch them, as wstool does."""

import argparse
import os
from pathlib import Path

from trundle.base.diagnostics import UsageError
from trundle.base.files import read_text
from trundle.robots.repositories import ListedRepository, read_repository_list, write_rosinstall

from ..repository_list import fetch_list

EXAMPLES = """
  wstool init src my_robot.rosinstall       a list for the workspace, and its repositories
  wstool set my_robot --git https://github.com/me/my_robot.git --version=noetic-devel -t src
  wstool merge -t src other.rosinstall      add another list
  wstool update -t src                      fetch the missing ones
  wstool info -t src
"""
_LIST = ".rosinstall"


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("command", choices=("init", "set", "merge", "update", "up", "info"), help="what to do")
    parser.add_argument("words", nargs="*", metavar="WORD", help="folder, file or name")
    parser.add_argument("-t", "--target-workspace", type=Path, default=Path(), metavar="DIR", help="folder (this one)")
    parser.add_argument("--git", action="store_true", help="set: the repository is one of git")
    parser.add_argument("-v", "--version", "--version-new", metavar="BRANCH", default="", help="set: branch or tag")
    parser.add_argument("-u", "--update", action="store_true", help="set: fetch it at once")
    for option in ("-y", "--confirm", "--shallow"):
        parser.add_argument(option, dest="unused", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("-j", "--parallel", metavar="N", help=argparse.SUPPRESS)


def main(args: argparse.Namespace) -> int:
    """Change the list, fetch its repositories, or print it."""
    folder = Path(args.words.pop(0)) if args.command == "init" and args.words else args.target_workspace
    file = folder / _LIST
    if args.command == "init":
        if os.path.lexists(file):
            raise UsageError(f"{file} exists already")
        return _merge(file, args.words, updates=bool(args.words))
    if not file.is_file():
        raise UsageError(f"no {file}; begin with: wstool init {folder}")
    match args.command:
        case "merge":
            return _merge(file, args.words, updates=False)
        case "set":
            if len(args.words) != 2:
                raise UsageError("wstool set needs a name and an address")
            name, url = args.words
            _add(file, read_repository_list(_entry(name, url, args.version), "wstool set"))
            return fetch_list(read_text(file), str(file), folder) if args.update else 0
        case "info":
            for listed in read_repository_list(read_text(file), str(file)):
                print(f"{listed.folder}  {listed.branch or 'default branch'}  {listed.url}")
            return 0
        case _:
            return fetch_list(read_text(file), str(file), folder)


def _merge(file: Path, lists: list[str], *, updates: bool) -> int:
    """Add the repositories of other lists."""
    file.parent.mkdir(parents=True, exist_ok=True)
    _add(file, [row for name in lists for row in read_repository_list(read_text(name), name)])
    return fetch_list(read_text(file), str(file), file.parent) if updates else 0


def _add(file: Path, rows: list[ListedRepository]) -> None:
    known = read_repository_list(read_text(file), str(file)) if file.is_file() else []
    merged = {row.folder: row for row in (*known, *rows)}
    file.write_text(write_rosinstall(merged.values()))


def _entry(name: str, url: str, version: str) -> str:
    return write_rosinstall([ListedRepository(name, url, version)])
