"""Fetch the repositories of a list into a workspace."""

import argparse
import sys
from pathlib import Path

from trundle.base.diagnostics import TrundleError
from trundle.robots.repositories import Checkout, read_repository_list

from .fetching import defaults, make_fetcher


def fetch_list(text: str, name: str, folder: Path) -> int:
    """Fetch the missing repositories, and return the exit code.

    Args:
        text: text of a .rosinstall or .repos file.
        name: name of the file, in errors.
        folder: parent of the repositories' folders.

    Raises:
        DescriptionError: the list cannot be read.
    """
    fetcher = make_fetcher(argparse.Namespace(**defaults()))
    failed = False
    for listed in read_repository_list(text, name):
        target = folder.absolute() / listed.folder
        if target.exists():
            print(f"{listed.folder}: already here")
            continue
        try:
            fetcher.fetch_repository(Checkout(listed.url, listed.branch, ""), target)
        except TrundleError as error:
            failed = True
            print(f"error: {listed.folder}: {error}", file=sys.stderr)
    return int(failed)
