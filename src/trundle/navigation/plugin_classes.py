"""Planners and layers of users in Python, by the lookup names of their plugins."""

import importlib.util
import os
import re
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from trundle.robots.packages import Packages
from trundle.robots.parameters import ParamError

if TYPE_CHECKING:
    from trundle.ros import Node

_Kind = TypeVar("_Kind")
_FOLDERS = (".", "plugins", "scripts", "src/{package}")
"""Where a package may have its plugins' files."""


def find_plugin_class(
    node: "Node", group: str, kind: type[_Kind], name: str, environment: Mapping[str, str] | None = None
) -> Callable[..., _Kind] | None:
    """Return the class of a plugin: an entry point of its lookup name, or a class of that name in the package.

    `my_planners/StraightLine` is the class StraightLine in `straight_line.py`, which the package `my_planners` has at
    its top or in `plugins`, `scripts` or `src/my_planners`. The log says which file is loaded.

    Args:
        node: node that logs.
        group: group of the entry points, such as 'trundle.navigation.layers'.
        kind: base class.
        name: lookup name, with `/` or `::` between package and class.
        environment: environment with ROS_PACKAGE_PATH; None: the process's.

    Raises:
        ParamError: the class has another base, or the file does not load, with its line.
    """
    from importlib.metadata import entry_points  # slow to load, and most robots use stock planners

    package, _, class_name = name.replace("::", "/").rpartition("/")
    for entry_point in entry_points(group=group):
        if entry_point.name.replace("::", "/") == f"{package}/{class_name}":
            node.log.info(f"plugin {name}: {entry_point.value}")
            return _checked(entry_point.load(), kind, name)
    if not re.fullmatch(r"\w+", package) or not class_name.isidentifier():
        return None
    folder = Packages(os.environ if environment is None else environment, start=Path.cwd()).find_package(package)
    if folder is None:
        return None
    for part in _FOLDERS:
        file = folder / part.format(package=package) / f"{_snake_case(class_name)}.py"
        if file.is_file():
            node.log.info(f"plugin {name}: {file}")
            return _checked(_load(file, class_name), kind, name)
    return None


def describe(error: Exception) -> str:
    """Return type and text of an exception of a user's code, and the line that raised it."""
    trace = error.__traceback__
    while trace is not None and trace.tb_next is not None:
        trace = trace.tb_next
    place = "" if trace is None else f"{trace.tb_frame.f_code.co_filename}:{trace.tb_lineno}: "
    return f"{place}{type(error).__name__}: {error}"


def _snake_case(name: str) -> str:
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", name).lower()


def _load(file: Path, class_name: str) -> object:
    name = f"trundle_navigation_plugin_{file.stem}_{abs(hash(file))}"
    spec = importlib.util.spec_from_file_location(name, file)
    assert spec is not None, file
    assert spec.loader is not None, file
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # dataclasses and pickle look the module up
    try:
        spec.loader.exec_module(module)
    except Exception as error:
        del sys.modules[name]
        text = f"{file}:{error.lineno}: {error.msg}" if isinstance(error, SyntaxError) else describe(error)
        raise ParamError(f"plugin not loaded: {text}") from error
    found = getattr(module, class_name, None)
    if found is None:
        raise ParamError(f"{file}: there is no class {class_name!r}")
    return found


def _checked(found: object, kind: type[_Kind], name: str) -> type[_Kind]:
    if not (isinstance(found, type) and issubclass(found, kind)):
        raise ParamError(f"plugin {name}: {found!r} is no subclass of {kind.__module__}.{kind.__name__}")
    return found
