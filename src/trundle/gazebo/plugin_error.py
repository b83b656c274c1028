"""Errors in the code of users' plugins, as a sentence and the traceback of that code."""

import traceback
from itertools import dropwhile
from pathlib import Path
from types import FrameType

from trundle.base.diagnostics import TrundleError
from trundle.gazebo.plugins import Hooks

_TRUNDLE_PACKAGE = "trundle."


def plugin_error(error: Exception) -> TrundleError | None:
    """Return an error with the file and hook of the user plugin that raised it; None: no plugin raised it.

    Args:
        error: exception from a hook or callback.
    """
    modules = _plugin_modules()
    frames = dropwhile(lambda frame: _module(frame[0]) not in modules, traceback.walk_tb(error.__traceback__))
    plugin_frames = [frame for frame in frames if not _module(frame[0]).startswith(_TRUNDLE_PACKAGE)]
    if not plugin_frames:
        return None
    code = plugin_frames[0][0].f_code
    lines = "".join(traceback.StackSummary.extract(iter(plugin_frames)).format()).rstrip()
    message = "".join(traceback.format_exception_only(error)).strip()
    return TrundleError(f"plugin {Path(code.co_filename).name}: {code.co_name}: {message}\n{lines}")


def _plugin_modules() -> set[str]:
    """Return the names of the modules that define user plugins."""
    modules: set[str] = set()
    kinds = Hooks.__subclasses__()
    while kinds:
        kind = kinds.pop()
        kinds += kind.__subclasses__()
        modules.add(kind.__module__)
    return {name for name in modules if not f"{name}.".startswith(_TRUNDLE_PACKAGE)}


def _module(frame: FrameType) -> str:
    return str(frame.f_globals.get("__name__", ""))
