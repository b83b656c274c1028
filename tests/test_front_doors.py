"""Front doors: each room lists its names once, in its stub, and imports them on first use."""

import importlib
import pkgutil
import subprocess
import sys

import pytest

import trundle


def _rooms() -> list[str]:
    """Every package that exports names."""
    found = pkgutil.walk_packages(trundle.__path__, "trundle.")
    names = [module.name for module in found if module.ispkg]
    return [name for name in names if hasattr(importlib.import_module(name), "__all__")]


@pytest.mark.parametrize("name", _rooms())
def test_every_exported_name_is_there(name) -> None:
    room = importlib.import_module(name)

    assert all(hasattr(room, name) for name in room.__all__)
    assert list(room.__all__) == sorted(set(room.__all__))


@pytest.mark.parametrize("name", _rooms())
def test_no_exported_name_is_that_of_a_module(name) -> None:
    """Import of the module would replace the name."""
    room = importlib.import_module(name)

    modules = {module.name for module in pkgutil.iter_modules(room.__path__)}
    assert not hasattr(room, "__getattr__") or not modules & set(room.__all__)


def test_a_room_imports_its_modules_on_first_use() -> None:
    code = """
import sys
import trundle.ros
print("trundle.ros.log" in sys.modules)
trundle.ros.LEVELS
print("trundle.ros.log" in sys.modules)
"""
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)

    assert found.stdout.split() == ["False", "True"]
