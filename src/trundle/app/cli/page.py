"""Print the links of the running pages.

A page opens only by its link, which has the token of the session. The links are in files that only the user who
started the pages may read.
"""

import argparse
import os
import sys

from trundle.base.diagnostics import UsageError

EXAMPLES = """
  trundle page link
  trundle page link --view-only
  trundle page link --foxglove
  trundle page link --port 8081
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    link = commands.add_parser("link", help="print the links of this user's pages, the newest first")
    kind = link.add_mutually_exclusive_group()
    kind.add_argument("--view-only", action="store_true", help="links that are view-only")
    kind.add_argument("--foxglove", action="store_true", help="links for Foxglove and Lichtblick")
    link.add_argument("--port", type=int, help="only the page at this port")


def main(args: argparse.Namespace) -> int:
    """Print the links, one per line."""
    from trundle.page import read_link_files

    pages = [page for page in read_link_files(os.environ) if args.port in (None, page.port)]
    if not pages:
        location = "" if args.port is None else f" at port {args.port}"
        raise UsageError(f"no page of this user runs{location}; start one, for example with 'trundle run WORLD'")
    for page in pages:
        link = page.view_url if args.view_only else page.foxglove_url if args.foxglove else page.url
        sys.stdout.write(f"{link}\n")
    return 0
