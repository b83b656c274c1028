"""Show or remove the log files of ROS."""

import argparse
import os
import shutil
import sys
from pathlib import Path

from .package_folder import log_parent

EXAMPLES = """
  rosclean check                size of the logs
  rosclean purge                remove them, after a question
  rosclean purge -y --size 100  remove the oldest until 100 MB are left
"""
_LABEL = "ROS node logs"
_MB = 1024 * 1024


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    commands = parser.add_subparsers(dest="command", required=True, metavar="{check,purge}")
    commands.add_parser("check", help="Check usage of log files").set_defaults(run=_check)
    purge = commands.add_parser("purge", help="Remove log files")
    purge.add_argument("-y", dest="yes", action="store_true", help="answer all questions with yes")
    purge.add_argument("--size", type=int, metavar="MB", help="keep the newest logs, up to this size")
    purge.set_defaults(run=_purge)


def main(args: argparse.Namespace) -> int:
    """Run the subcommand; do nothing if there are no logs."""
    folder = log_parent(os.environ)
    return args.run(args, folder) if folder.is_dir() else 0


def _check(_: argparse.Namespace, folder: Path) -> int:
    print(f"{_readable(_size(folder))} {_LABEL}")
    return 0


def _purge(args: argparse.Namespace, folder: Path) -> int:
    size = _size(folder)
    if args.size is not None and size <= args.size * _MB:
        print(
            f"Directory size of {_LABEL} is {size // _MB} MB which is already below the requested threshold of "
            f"{args.size} MB."
        )
        return 0
    if args.size is None:
        print(f"Purging {_LABEL}.")
        question = f"rm -rf {folder}"
    else:
        print(f"Purging {_LABEL} until directory size is at most {args.size} MB (currently {size // _MB} MB).")
        question = f"Purge some of old logs in {folder}"
    if not args.yes:
        print("PLEASE BE CAREFUL TO VERIFY THE COMMAND BELOW!")
        if not _confirm(question):
            return 0
    for path in sorted(folder.iterdir(), key=lambda path: path.lstat().st_mtime):
        if args.size is not None and size <= args.size * _MB:
            return 0
        size -= _size(path)
        _remove(path)
    if args.size is None and not folder.is_symlink():
        folder.rmdir()
    return 0


def _confirm(question: str) -> bool:
    print(f"Okay to perform:\n\n{question}\n(y/n)?", flush=True)
    for line in sys.stdin:
        if line.strip().lower() in ("y", "n"):
            return line.strip().lower() == "y"
    return False


def _remove(path: Path) -> None:
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    else:
        path.unlink()


def _size(path: Path) -> int:
    """Return the size on disk of a file or folder [bytes]; links are not followed."""
    paths = [path] if path.is_symlink() or not path.is_dir() else path.rglob("*")
    return sum(os.lstat(item).st_size for item in paths if os.path.lexists(item))


def _readable(size: int) -> str:
    """Return a size as `du -h` prints it: 512, 4.0K, 12M."""
    number, unit = float(size), ""
    for unit in ("", "K", "M", "G", "T"):
        if number < 1024.0 or unit == "T":
            break
        number /= 1024.0
    return f"{number:.0f}{unit}" if not unit or number >= 10.0 else f"{number:.1f}{unit}"
