"""Options that several commands have."""

import argparse
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from trundle.page_address import AllowedNames


def add_allow_outside(parser: argparse.ArgumentParser) -> None:
    """Declare the option of every command that reads a description."""
    parser.add_argument(
        "--allow-outside", action="store_true", help="read files outside the packages and resource paths too"
    )


def add_lenient(parser: argparse.ArgumentParser) -> None:
    """Declare the option of every command that reads robots as their authors wrote them."""
    parser.add_argument(
        "--lenient", action="store_true", help="leave out xacro:includes of packages that are not there, and say so"
    )


def add_page_access(parser: argparse.ArgumentParser) -> None:
    """Declare the options of every command that serves a page."""
    for option, metavar, what in (
        ("--allow-host", "NAME", "serve the page at this name too, as behind a proxy; may be given again"),
        ("--allow-origin", "ORIGIN", "let web pages of this origin in, such as https://robot.example:8443"),
    ):
        parser.add_argument(option, action="append", default=[], metavar=metavar, help=what)


def page_access(args: argparse.Namespace) -> "AllowedNames":
    """Return what `add_page_access` declared.

    Raises:
        UsageError: a name is none.
    """
    from trundle.page_address import AllowedNames

    return AllowedNames(hosts=tuple(args.allow_host), origins=tuple(args.allow_origin))


def add_renderer(parser: argparse.ArgumentParser) -> None:
    """Declare the option of every command that draws."""
    what = "what draws: Trundle's own renderer, or OpenGL over EGL, without textures and fog (cpu)"
    parser.add_argument("--renderer", choices=("cpu", "egl"), default="cpu", help=what)
