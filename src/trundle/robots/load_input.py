"""Input of a description: a file, a pipe or standard input."""

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from trundle.base.diagnostics import DescriptionError, Diagnostics, Source
from trundle.base.files import is_stream, read_standard_input, read_stream
from trundle.robots.description import LoadedDescription, load, load_text
from trundle.robots.packages import Packages

_STANDARD_INPUT = "-"


class Piped(NamedTuple):
    """Contents of a pipe or standard input."""

    name: str
    """Name in messages."""
    data: bytes


def read_piped(file: str) -> Piped | None:
    """Read standard input, "-", or a pipe; None if `file` is neither.

    Raises:
        DescriptionError: the file cannot be read.
    """
    is_standard = file == _STANDARD_INPUT
    if not is_standard and not is_stream(file):
        return None
    name = "<stdin>" if is_standard or Path(file).name == "stdin" else "<pipe>"
    try:
        return Piped(name, read_standard_input() if is_standard else read_stream(file))
    except OSError as error:
        raise DescriptionError(
            Source(name if is_standard else file), f"cannot be read: {error.strerror}", "unreadable-file"
        ) from None


def report_workspace(file: str, packages: Packages, log: Callable[[str], None]) -> None:
    """Log the workspace of a package:// URI, unless it is on ROS_PACKAGE_PATH."""
    scheme, _, rest = file.partition("://")
    folder = packages.find_package(rest.partition("/")[0]) if scheme == "package" else None
    workspace = None if folder is None else packages.workspace_of(folder)
    if workspace is not None:
        log(f"using the workspace {workspace}")


def load_input(
    file: str, report: Diagnostics, *, packages: Packages, start: Path, piped: Piped | None = None
) -> LoadedDescription:
    """Read a description.

    Args:
        file: source for `trundle.robots.description.load`, or "-" for standard input.
        report: receives all findings.
        packages: resolves URIs.
        start: base of relative URIs in standard input.
        piped: contents of `file`, if already read.

    Raises:
        DescriptionError: the file cannot be read.
        UsageError: no such model.
    """
    piped = piped or read_piped(file)
    if piped is not None:
        return load_text(piped.data, name=piped.name, folder=start, packages=packages, report=report)
    report_workspace(file, packages, lambda message: report.info(Source(file), message, "workspace"))
    return load(file, report, packages=packages)
