"""Loads the user's Python 2 modules translated; Python's own finder finds them."""

import os
import sys
from collections.abc import Sequence
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from types import CodeType, ModuleType

_TRUNDLE = os.path.abspath(os.path.join(__file__, "../../../.."))
_SYSTEM = tuple(
    os.path.join(os.path.realpath(folder), "") for folder in (sys.prefix, sys.base_prefix, "/usr", "/opt/ros", _TRUNDLE)
)
"""Folders whose modules are Python 3."""


class TranslatingFinder:
    """Meta-path finder just before Python's own; it only changes the loader of the user's modules."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Find a module as Python would."""
        return with_translation(PathFinder.find_spec(fullname, path, target))


def with_translation(spec: ModuleSpec | None) -> ModuleSpec | None:
    """Replace the loader of a user's module by one that translates Python 2."""
    if spec is None or type(spec.loader) is not SourceFileLoader or spec.origin is None:
        return spec
    if not os.path.realpath(spec.origin).startswith(_SYSTEM):
        spec.loader = _Loader(spec.name, spec.origin)
    return spec


def install() -> None:
    """Put the finder before Python's, once."""
    if not any(isinstance(finder, TranslatingFinder) for finder in sys.meta_path):
        indices = [index for index, finder in enumerate(sys.meta_path) if finder is PathFinder]
        sys.meta_path.insert(indices[0] if indices else len(sys.meta_path), TranslatingFinder())


class _Loader(SourceFileLoader):
    """Python's source loader; translated code is not cached in __pycache__, where other Pythons would load it."""

    _is_translated = False

    def get_code(self, fullname: str) -> CodeType | None:
        from .cache import is_python2_file, translated_code

        in_package = "." in fullname or self.is_package(fullname)
        if not is_python2_file(self.path, in_package=in_package):
            return super().get_code(fullname)
        self._is_translated = True
        return translated_code(self.path, in_package=in_package)

    def exec_module(self, module: ModuleType) -> None:
        code = self.get_code(module.__name__)
        if code is None or not self._is_translated:
            super().exec_module(module)
            return
        from .names import add_module_names, python2_builtins

        add_module_names()
        module.__dict__["__builtins__"] = python2_builtins()
        exec(code, module.__dict__)
