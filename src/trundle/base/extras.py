"""Optional packages, which Trundle's extras install."""

import importlib
import json
import shlex
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlsplit

from trundle.base.diagnostics import UsageError


def import_extra(module: str, *, extra: str = "sweep") -> Any:
    """Import a module of a package that belongs to an extra.

    Raises:
        UsageError: it is not installed; the message says how to install it.
    """
    package = module.partition(".")[0]
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        if not (error.name or "").startswith(package):
            raise
        raise UsageError(f"this needs {package}, which is not installed: pip install 'trundle[{extra}]'") from None


def rospy_requirements() -> str:
    """Return the arguments of `pip install` that bring ROS' packages to any Python: names, or paths into the checkout
    from which this Trundle was installed.
    """
    from importlib import metadata  # its import takes a tenth of the time of a launch's imports

    try:
        record = metadata.distribution("trundle").read_text("direct_url.json")
    except metadata.PackageNotFoundError:
        record = None
    url = str(json.loads(record).get("url", "")) if record else ""
    checkout = Path(unquote(urlsplit(url).path)) if url.startswith("file:") else Path(__file__).parents[3]
    package = checkout / "packaging/trundle-rospy"
    return shlex.join([str(checkout), str(package)]) if package.is_dir() else "trundle-rospy"
