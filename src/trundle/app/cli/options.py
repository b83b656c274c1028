"""Options shared by several commands."""

import argparse
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from trundle.base.http.page_address import AllowedNames


def add_allow_outside(parser: argparse.ArgumentParser) -> None:
    """Declare the option of commands that read descriptions."""
    parser.add_argument(
        "--allow-outside", action="store_true", help="read files outside the packages and resource paths too"
    )


def add_lenient(parser: argparse.ArgumentParser) -> None:
    """Declare the option of commands that read robots."""
    parser.add_argument("--lenient", action="store_true", help="leave out what needs missing packages, with warnings")


def add_page_access(parser: argparse.ArgumentParser) -> None:
    """Declare the options of commands that serve a page."""
    for option, metavar, what in (
        ("--allow-host", "NAME", "also accept this host name, as behind a proxy; repeatable"),
        ("--allow-origin", "ORIGIN", "also accept the page by this origin, such as https://robot.example; repeatable"),
    ):
        parser.add_argument(option, action="append", default=[], metavar=metavar, help=what)
    what = "print a second link, which only allows looking"
    parser.add_argument("--view-only", action="store_true", help=what)
    what = "print the page's URL only; else it is opened where a terminal has a display"
    parser.add_argument("--no-browser", action="store_true", help=what)


def page_access(args: argparse.Namespace) -> "AllowedNames":
    """Return the options that `add_page_access` declared.

    Raises:
        UsageError: a name is invalid.
    """
    from trundle.base.http.page_address import AllowedNames

    return AllowedNames(hosts=tuple(args.allow_host), origins=tuple(args.allow_origin))


def add_renderer(parser: argparse.ArgumentParser) -> None:
    """Declare the option of commands that render."""
    what = "renderer: Trundle's own, or OpenGL over EGL, without textures and fog (cpu)"
    parser.add_argument("--renderer", choices=("cpu", "egl"), default="cpu", help=what)
