"""A description by its name, or from standard input."""

from collections.abc import Callable
from pathlib import Path

from trundle.description import Loaded, load, load_text
from trundle.diagnostics import DescriptionError, Diagnostics, Source
from trundle.files import read_standard_input
from trundle.packages import Packages

STANDARD_INPUT = "-"


def name_workspace(file: str, packages: Packages, say: Callable[[str], None]) -> None:
    """Say which workspace a package:// leads into, where ROS_PACKAGE_PATH does not name it."""
    scheme, _, rest = file.partition("://")
    folder = packages.find_package(rest.partition("/")[0]) if scheme == "package" else None
    workspace = None if folder is None else packages.workspace_of(folder)
    if workspace is not None:
        say(f"using the workspace {workspace}")


def load_described(file: str, report: Diagnostics, *, packages: Packages, start: Path) -> Loaded:
    """Read a description.

    Args:
        file: as `trundle.description.load` takes it, or "-" for standard input.
        report: takes everything worth saying.
        packages: where URIs lead.
        start: relative URIs in standard input start here.

    Raises:
        DescriptionError: of which nothing sensible can be made.
        UsageError: no such model.
    """
    if file != STANDARD_INPUT:
        name_workspace(file, packages, lambda what: report.info(Source(file), what))
        return load(file, report, packages=packages)
    name = "<stdin>"
    try:
        text = read_standard_input()
    except OSError as error:
        raise DescriptionError(Source(name), f"cannot be read: {error.strerror}") from None
    return load_text(text, name=name, folder=start, packages=packages, report=report)
