"""Finds the plugin that a <plugin filename="…"> asks for.

In this order: Trundle's own by Gazebo's file name; installed ones (entry points of the group
"trundle.plugins", named by file name); a Python file of the user's: `librp2w.so` means `rp2w.py` beside the
model, else on TRUNDLE_PLUGIN_PATH, else on GAZEBO_PLUGIN_PATH.
"""

import importlib
import importlib.util
import os
import sys
from collections.abc import Mapping
from importlib.metadata import entry_points
from pathlib import Path, PurePosixPath

from trundle.diagnostics import DescriptionError, Source
from trundle.model import PluginTag

from .plugin import Plugin

BUILTIN: dict[str, str] = {
    "libBuoyancyPlugin.so": "trundle.plugins.buoyancy:Buoyancy",
    "libDiffDrivePlugin.so": "trundle.plugins.diff_drive:DiffDrive",
    "libInitialVelocityPlugin.so": "trundle.plugins.initial_velocity:InitialVelocity",
    "libLiftDragPlugin.so": "trundle.plugins.lift_drag:LiftDrag",
    "libSkidSteerDrivePlugin.so": "trundle.plugins.skid_steer_drive:SkidSteerDrive",
}
"""File name → "module:Class", imported only when a model asks."""

GROUP = "trundle.plugins"


def find_plugin(tag: PluginTag, environment: Mapping[str, str]) -> tuple[type[Plugin], str]:
    """Return the plugin's class and where it came from.

    Raises:
        DescriptionError: there is none, with where was looked; or the user's file does not load, with its line.
    """
    filename = PurePosixPath(tag.filename.replace("\\", "/")).name
    if filename in BUILTIN:
        return _imported(BUILTIN[filename]), f"Trundle's own {filename}"
    for guest in entry_points(group=GROUP, name=filename):
        return guest.load(), f"{guest.value} ({guest.dist.name if guest.dist else 'installed'})"
    folders = _folders(tag, environment)
    for folder in folders:
        path = folder / python_name(filename)
        if path.is_file():
            return _load_file(path), str(path)
    what = f"plugin {tag.name!r}: no {filename}; Trundle runs Python plugins"
    looked = ", ".join(map(str, folders))
    raise DescriptionError(tag.at, f"{what}: looked for {python_name(filename)} in {looked}")


def python_name(filename: str) -> str:
    """`librp2w.so` → `rp2w.py`, the file in which a user writes the plugin anew."""
    stem = PurePosixPath(filename).stem
    if filename.endswith(".so"):
        stem = stem.removeprefix("lib")
    return f"{stem}.py"


def _folders(tag: PluginTag, environment: Mapping[str, str]) -> list[Path]:
    folders = [Path(tag.at.file).resolve().parent]
    for variable in ("TRUNDLE_PLUGIN_PATH", "GAZEBO_PLUGIN_PATH"):
        folders += [Path(entry) for entry in environment.get(variable, "").split(os.pathsep) if entry]
    return folders


def _imported(path: str) -> type[Plugin]:
    module, _, name = path.partition(":")
    return getattr(importlib.import_module(module), name)


def _load_file(path: Path) -> type[Plugin]:
    name = f"trundle_plugin_{path.stem}_{abs(hash(path))}"
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None, path
    assert spec.loader is not None, path
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # dataclasses and pickle look their module up
    try:
        spec.loader.exec_module(module)
    except Exception as error:
        del sys.modules[name]
        raise DescriptionError(_culprit(path, error), f"plugin not loaded: {describe(error)}") from error
    found = [
        value
        for value in vars(module).values()
        if isinstance(value, type) and issubclass(value, Plugin) and value.__module__ == name
    ]
    if len(found) != 1:
        names = ", ".join(repr(c.__name__) for c in found) or "none"
        raise DescriptionError(Source(str(path)), f"a plugin file defines one subclass of Plugin; here: {names}")
    return found[0]


def describe(error: Exception) -> str:
    """An exception of a user's plugin in a few words."""
    return f"{type(error).__name__}: {error}"


def _culprit(path: Path, error: Exception) -> Source:
    """The deepest line of the user's own file that the error came through."""
    if isinstance(error, SyntaxError):
        return Source(str(path), error.lineno)
    line: int | None = None
    trace = error.__traceback__
    while trace is not None:
        if trace.tb_frame.f_code.co_filename == str(path):
            line = trace.tb_lineno
        trace = trace.tb_next
    return Source(str(path), line)
