"""Errors in the code of a user's plugins, as a sentence and the lines of that code."""

import traceback
from itertools import dropwhile
from pathlib import Path
from types import FrameType

from trundle.base.diagnostics import TrundleError
from trundle.gazebo.plugins import Hooks

_OURS = "trundle."


def plugin_error(error: Exception) -> TrundleError | None:
    """Error of a user's plugin that names its file and hook; None: it did not come out of one.

    Args:
        error: raised while hooks and callbacks ran.
    """
    modules = _plugin_modules()
    frames = dropwhile(lambda each: _module(each[0]) not in modules, traceback.walk_tb(error.__traceback__))
    theirs = [each for each in frames if not _module(each[0]).startswith(_OURS)]
    if not theirs:
        return None
    code = theirs[0][0].f_code
    lines = "".join(traceback.StackSummary.extract(iter(theirs)).format()).rstrip()
    what = "".join(traceback.format_exception_only(error)).strip()
    return TrundleError(f"plugin {Path(code.co_filename).name}: {code.co_name}: {what}\n{lines}")


def _plugin_modules() -> set[str]:
    """Names of the modules that define plugins that are not Trundle's."""
    found: set[str] = set()
    kinds = Hooks.__subclasses__()
    while kinds:
        kind = kinds.pop()
        kinds += kind.__subclasses__()
        found.add(kind.__module__)
    return {name for name in found if not name.startswith(_OURS)}


def _module(frame: FrameType) -> str:
    return str(frame.f_globals.get("__name__", ""))
