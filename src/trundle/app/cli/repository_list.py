"""Fetches the repositories of a list into a workspace."""

import argparse
import sys
from pathlib import Path

from trundle.base.diagnostics import TrundleError
from trundle.robots.repositories import Checkout, read_repository_list

from .fetching import defaults, make_fetcher


def fetch_list(text: str, name: str, folder: Path) -> int:
    """Fetch what is not there yet, and return the exit code.

    Args:
        text: of a .rosinstall or .repos file.
        name: of the file, in errors.
        folder: below which each repository has the folder that the list names.

    Raises:
        DescriptionError: the list cannot be read.
    """
    fetcher = make_fetcher(argparse.Namespace(**defaults()))
    failed = False
    for listed in read_repository_list(text, name):
        target = folder.absolute() / listed.folder
        if target.exists():
            print(f"{listed.folder}: here already")
            continue
        try:
            fetcher.fetch_repository(Checkout(listed.url, listed.branch, ""), target)
        except TrundleError as error:
            failed = True
            print(f"error: {listed.folder}: {error}", file=sys.stderr)
    return int(failed)
