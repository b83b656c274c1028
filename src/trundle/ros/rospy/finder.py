"""Finder at the end of `sys.meta_path`: installed packages win.

It serves the packages in `modules/`, the Python modules of the ROS packages around the program, and `PACKAGE.msg` and
`PACKAGE.srv` generated from definitions. Loaded at the start of every process, so it imports the rest on first use.
"""

import os
import sys
from collections.abc import Sequence
from importlib.machinery import ModuleSpec, PathFinder
from types import ModuleType

TYPE_CHECKING = False  # not from `typing`, whose import takes longer than this module's
if TYPE_CHECKING:
    from collections.abc import Callable
    from importlib.abc import Loader
    from types import TracebackType
    from typing import Any

_HERE = os.path.dirname(os.path.abspath(__file__))
MODULES = os.path.join(_HERE, "modules")
_MESSAGES = os.path.join(_HERE, "../../assets/messages")
_BUNDLES, _DEFINITIONS = os.path.join(_MESSAGES, "standard"), os.path.join(_MESSAGES, "definitions")
_KINDS = ("msg", "srv")
_PARTIAL = frozenset({"genmsg", "genpy", "roslib", "rosunit"})
"""Packages with modules that `missing_modules` lists."""
_NOT_SEARCHED = frozenset({"java", "org", "sitecustomize", "trundle", "usercustomize"})
"""Names that no ROS package has; copy, pickle and platform try Jython's."""


class RosFinder:
    """Meta-path finder of ROS packages."""

    def __init__(self) -> None:
        self._is_searching = False
        """True during a search for packages; imports of the search itself are not searched."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Find a module; None if it is not one of ROS' modules."""
        del path, target
        package, dot, rest = fullname.partition(".")
        if not dot:
            return _find_shipped(fullname) or self._find_in_workspace(fullname)
        kind, _, name = rest.partition(".")
        if kind in _KINDS and (not name or name.startswith("_")):
            return self._find_messages(fullname, package, kind, name[1:])
        if kind == "cfg":
            return self._find_cfg(fullname, package, name)
        if package in _PARTIAL:
            from .missing_modules import find_missing

            return find_missing(fullname)
        return None

    def _find_messages(self, fullname: str, package: str, kind: str, name: str) -> ModuleSpec | None:
        """Find `PACKAGE.msg` or `PACKAGE.msg._Name`."""
        if not self._defines(package):
            return None
        from .message_modules import MessagesLoader

        return ModuleSpec(fullname, _loader(MessagesLoader(package, kind, name)), is_package=not name)

    def _find_cfg(self, fullname: str, package: str, name: str) -> ModuleSpec | None:
        """Find `PACKAGE.cfg.NAMEConfig`, which catkin generates from `cfg/NAME.cfg`."""

        def find() -> ModuleSpec | None:
            from .cfg_modules import find_cfg

            return find_cfg(fullname, package, name)

        return self._search(find)

    def _defines(self, package: str) -> bool:
        return _is_shipped(package) or bool(self._search(lambda: _has_definitions(package)))

    def _find_in_workspace(self, name: str) -> ModuleSpec | None:
        """Find a module or message package of the ROS packages around the program."""
        if name.startswith("_") or name in sys.stdlib_module_names or name in _NOT_SEARCHED:
            return None
        return self._search(lambda: _find_in_workspace(name))

    def _search(self, find: "Callable[[], Any]") -> "Any":
        if self._is_searching:
            return None
        self._is_searching = True
        try:
            return find()
        finally:
            self._is_searching = False


def install() -> None:
    """Append the finder, once; tracebacks of missing modules and Python 2 programs then end with advice."""
    if any(isinstance(finder, RosFinder) for finder in sys.meta_path):
        return
    sys.meta_path.append(RosFinder())
    previous = sys.excepthook

    def advise(kind: type[BaseException], error: BaseException, trace: "TracebackType | None") -> None:
        previous(kind, error, trace)
        if isinstance(error, Exception):
            from .missing_libraries import advice

            if (line := advice(error)) is not None:
                sys.stderr.write(f"{line}\n")

    sys.excepthook = advise


def _loader(loader: "Any") -> "Loader":
    """Annotate loaders by their methods, as importlib.abc takes long to import."""
    return loader


class _MessagePackage:
    """Loader of a package that has messages and no `__init__.py`."""

    def create_module(self, spec: ModuleSpec) -> None:
        """Leave the module to Python."""

    def exec_module(self, module: ModuleType) -> None:
        """Nothing to run."""


def _find_shipped(name: str) -> ModuleSpec | None:
    spec = PathFinder.find_spec(name, [MODULES]) if os.path.exists(os.path.join(MODULES, name)) else None
    if spec is None:
        path = os.path.join(MODULES, f"{name}.py")
        spec = PathFinder.find_spec(name, [MODULES]) if os.path.isfile(path) else None
    if spec is not None and spec.origin is not None:
        return spec
    return _message_package(name, spec) if spec is not None or _is_shipped(name) else None


def _find_in_workspace(name: str) -> ModuleSpec | None:
    from .package_folders import find_module

    path = find_module(name)
    if path is None:
        return _message_package(name, None) if _has_definitions(name) or _has_cfg(name) else None
    from .python2.loader import with_translation

    spec = with_translation(
        PathFinder.find_spec(name, [str(path.parent)]) if path.stem == name else _package_at(name, str(path))
    )
    return spec if spec is None or spec.origin is not None else _message_package(name, spec)


def _package_at(name: str, folder: str) -> ModuleSpec | None:
    """Load a package from a folder of another name, as setup.py's package_dir says."""
    from importlib.util import spec_from_file_location

    init = os.path.join(folder, "__init__.py")
    return spec_from_file_location(name, init, submodule_search_locations=[folder]) if os.path.isfile(init) else None


def _message_package(name: str, folder_spec: ModuleSpec | None) -> ModuleSpec:
    spec = ModuleSpec(name, _loader(_MessagePackage()), is_package=True)
    if folder_spec is not None and folder_spec.submodule_search_locations is not None:
        spec.submodule_search_locations = list(folder_spec.submodule_search_locations)
    return spec


def _is_shipped(package: str) -> bool:
    return os.path.isfile(os.path.join(_BUNDLES, f"{package}.txt")) or os.path.isdir(
        os.path.join(_DEFINITIONS, package)
    )


def _has_definitions(package: str) -> bool:
    from .message_sources import find_definitions

    return not find_definitions(package).is_empty


def _has_cfg(package: str) -> bool:
    from .package_folders import find_package

    folder = find_package(package)
    return folder is not None and os.path.isdir(folder / "cfg")
