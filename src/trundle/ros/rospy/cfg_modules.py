"""`PACKAGE.cfg` and `PACKAGE.cfg.NAMEConfig`, which catkin generates from a package's `cfg/NAME.cfg`."""

import os
from importlib.machinery import ModuleSpec
from pathlib import Path
from types import ModuleType
from typing import Any, Protocol, cast

from .package_folders import find_package


class _ConfigReader(Protocol):
    """Functions of `dynamic_reconfigure.config_reader`."""

    def config_namespace(self, package: str, file: Path) -> dict[str, Any]:
        """Namespace of the module that is generated from a .cfg file."""
        ...


class _Loader:
    """Loader of a generated module; without a file, of the package `PACKAGE.cfg`."""

    def __init__(self, package: str, file: Path | None) -> None:
        self._package = package
        self._file = file

    def create_module(self, spec: ModuleSpec) -> None:
        """Leave the module to Python."""

    def exec_module(self, module: ModuleType) -> None:
        """Fill the module from its .cfg file."""
        if self._file is None:
            return
        from importlib import import_module

        reader = cast(_ConfigReader, import_module("dynamic_reconfigure.config_reader"))
        module.__dict__.update(reader.config_namespace(self._package, self._file))


def find_cfg(fullname: str, package: str, name: str) -> ModuleSpec | None:
    """Find `PACKAGE.cfg`, or with `name` one of its modules; None if the package has no such file."""
    folder = find_package(package)
    if folder is None or not os.path.isdir(folder / "cfg"):
        return None
    if not name:
        return ModuleSpec(fullname, cast(Any, _Loader(package, None)), is_package=True)
    file = folder / "cfg" / f"{name.removesuffix('Config')}.cfg"
    if not name.endswith("Config") or not os.path.isfile(file):
        return None
    return ModuleSpec(fullname, cast(Any, _Loader(package, file)), origin=str(file))
