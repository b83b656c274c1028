"""Options shared by several commands."""

import argparse
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from trundle.base.diagnostics import UsageError

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

    from trundle.base.http.page_address import AllowedNames

_Options = TypeVar("_Options", bound="DataclassInstance")


def field_option(parser: argparse.ArgumentParser) -> Callable[..., argparse.Action]:
    """Return a function that declares an option for the field `dest`, with the default of the options' class."""
    return partial(parser.add_argument, default=argparse.SUPPRESS)


def read_options(kind: type[_Options], args: argparse.Namespace, **more: object) -> _Options:
    """Make a command's options from its arguments.

    Args:
        kind: dataclass of the options, with their defaults.
        args: arguments; those with a field's name set it.
        more: values of further fields.
    """
    from dataclasses import fields  # lazy: dataclasses imports inspect

    names = {field.name for field in fields(kind)}
    values: dict[str, Any] = {name: value for name, value in vars(args).items() if name in names}
    return kind(**values | more)


def add_timeline(parser: argparse.ArgumentParser) -> None:
    """Declare the option of commands whose page has a timeline."""
    field_option(parser)(
        "--timeline",
        type=_megabytes,
        dest="timeline_mb",
        metavar="MB",
        help="memory for the last minutes, which the page goes back to; 0: none (256)",
    )


def _megabytes(text: str) -> int:
    value = int(text)
    if value < 0:
        raise argparse.ArgumentTypeError(f"{text} is not a size; give megabytes, such as 256")
    return value


def add_compare(parser: argparse.ArgumentParser) -> None:
    """Declare the option of commands whose page compares what it shows with a recording."""
    help_ = "recording to compare with, a state log, .bag or .mcap: as a ghost, in plots and in numbers"
    field_option(parser)("--compare", type=Path, metavar="FILE", help=help_)


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
    for option, metavar, help_ in (
        ("--allow-host", "NAME", "also accept this host name, as behind a proxy; repeatable"),
        ("--allow-origin", "ORIGIN", "also accept the page by this origin, such as https://robot.example; repeatable"),
    ):
        parser.add_argument(option, action="append", default=[], metavar=metavar, help=help_)
    view_only = "print a second link, which is view-only"
    parser.add_argument("--view-only", action="store_true", help=view_only)
    no_browser = "only print the page's URL; else open it if a terminal has a display"
    field_option(parser)("--no-browser", action="store_false", dest="opens_browser", help=no_browser)


def page_access(args: argparse.Namespace) -> "AllowedNames":
    """Return the options that `add_page_access` declared.

    Raises:
        UsageError: a name is invalid.
    """
    from trundle.base.http.page_address import AllowedNames

    return AllowedNames(hosts=tuple(args.allow_host), origins=tuple(args.allow_origin))


def add_lesson(parser: argparse.ArgumentParser) -> None:
    """Declare the option of commands whose page may open a lesson."""
    lesson = "open a lesson in the page: one that Trundle brings, such as rp2w or smartcar, or a Markdown file"
    parser.add_argument("--lesson", metavar="NAME|FILE.md", help=lesson)


def checked_lesson(args: argparse.Namespace) -> str | None:
    """Return the option that `add_lesson` declared.

    Raises:
        TrundleError: there is no such lesson, it cannot be read, or there is no page.
    """
    if args.lesson is None:
        return None
    from trundle.page.lessons.read import read_lesson

    if "headless" in args:
        raise UsageError("--lesson needs the page, which --headless leaves out")
    read_lesson(args.lesson)
    return args.lesson


def add_renderer(parser: argparse.ArgumentParser) -> None:
    """Declare the option of commands that render."""
    renderer = "renderer: Trundle's own, or OpenGL over EGL, without textures and fog (cpu)"
    parser.add_argument("--renderer", choices=("cpu", "egl"), default="cpu", help=renderer)
