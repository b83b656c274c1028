"""Public packages list their names in their stubs and import them on first use."""

import importlib
import pkgutil
import subprocess
import sys

import pytest

import trundle


def _packages() -> list[str]:
    """Return all packages that export names."""
    modules = pkgutil.walk_packages(trundle.__path__, "trundle.")
    names = [module.name for module in modules if module.ispkg]
    return [name for name in names if hasattr(importlib.import_module(name), "__all__")]


@pytest.mark.parametrize("name", _packages())
def test_exported_names_exist(name: str) -> None:
    room = importlib.import_module(name)

    assert all(hasattr(room, name) for name in room.__all__)
    assert list(room.__all__) == sorted(set(room.__all__))


@pytest.mark.parametrize("name", _packages())
def test_exported_names_differ_from_module_names(name: str) -> None:
    """The import of the module would replace the name."""
    room = importlib.import_module(name)

    modules = {module.name for module in pkgutil.iter_modules(room.__path__)}
    assert not hasattr(room, "__getattr__") or not modules & set(room.__all__)


def test_a_package_imports_its_modules_on_first_use() -> None:
    code = """
import sys
import trundle.ros
print("trundle.ros.log" in sys.modules)
trundle.ros.LEVELS
print("trundle.ros.log" in sys.modules)
"""
    process = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)

    assert process.stdout.split() == ["False", "True"]
