"""Packages of the extra `sweep`."""

import importlib
from typing import Any

from trundle.diagnostics import UsageError


def import_extra(module: str) -> Any:
    """Import a module of pyarrow or scipy.

    Raises:
        UsageError: it is not installed; says how to install it.
    """
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        if not (error.name or "").startswith(module.partition(".")[0]):
            raise
        package = module.partition(".")[0]
        raise UsageError(f"sweeps need {package}, which is not installed: pip install 'trundle[sweep]'") from None
