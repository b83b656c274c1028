"""Input of a description: by name, from a pipe or from standard input."""

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from trundle.base.diagnostics import DescriptionError, Diagnostics, Source
from trundle.base.files import is_stream, read_standard_input, read_stream
from trundle.robots.description import LoadedDescription, load, load_text
from trundle.robots.packages import Packages

_STANDARD_INPUT = "-"


class Piped(NamedTuple):
    """Contents that came through a pipe or standard input."""

    name: str
    """Name in messages."""
    data: bytes


def read_piped(file: str) -> Piped | None:
    """Read standard input, "-", or a pipe; None: `file` is neither.

    Raises:
        DescriptionError: it cannot be read.
    """
    is_standard = file == _STANDARD_INPUT
    if not is_standard and not is_stream(file):
        return None
    name = "<stdin>" if is_standard or Path(file).name == "stdin" else "<pipe>"
    try:
        return Piped(name, read_standard_input() if is_standard else read_stream(file))
    except OSError as error:
        raise DescriptionError(Source(name if is_standard else file), f"cannot be read: {error.strerror}") from None


def report_workspace(file: str, packages: Packages, say: Callable[[str], None]) -> None:
    """Print the workspace that a package:// was found in, if ROS_PACKAGE_PATH does not name it."""
    scheme, _, rest = file.partition("://")
    folder = packages.find_package(rest.partition("/")[0]) if scheme == "package" else None
    workspace = None if folder is None else packages.workspace_of(folder)
    if workspace is not None:
        say(f"using the workspace {workspace}")


def load_input(
    file: str, report: Diagnostics, *, packages: Packages, start: Path, piped: Piped | None = None
) -> LoadedDescription:
    """Read a description.

    Args:
        file: as `trundle.robots.description.load` takes it, or "-" for standard input.
        report: takes all findings.
        packages: resolve URIs.
        start: relative URIs in standard input start here.
        piped: contents of `file`, if read already.

    Raises:
        DescriptionError: the file cannot be read.
        UsageError: no such model.
    """
    piped = piped or read_piped(file)
    if piped is not None:
        return load_text(piped.data, name=piped.name, folder=start, packages=packages, report=report)
    report_workspace(file, packages, lambda what: report.info(Source(file), what))
    return load(file, report, packages=packages)
