"""Packages of Trundle's extras, which not everyone has."""

import importlib
from typing import Any

from trundle.diagnostics import UsageError


def import_extra(module: str, *, extra: str = "sweep") -> Any:
    """Import a module of a package that belongs to an extra.

    Raises:
        UsageError: it is not installed; says how to install it.
    """
    package = module.partition(".")[0]
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        if not (error.name or "").startswith(package):
            raise
        raise UsageError(f"this needs {package}, which is not installed: pip install 'trundle[{extra}]'") from None
