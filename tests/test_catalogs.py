"""Catalogs: all named classes exist."""

from importlib import import_module
from pathlib import Path

import pytest

from trundle.gazebo.nodes.catalog import BUILTIN_NODES, NODELETS
from trundle.gazebo.plugins.catalog import BUILTIN, SENSOR_PLUGINS
from trundle.gazebo.plugins.ros_control.catalog import CONTROLLERS
from trundle.robots.packages import Packages

_CATALOGS = (BUILTIN, SENSOR_PLUGINS, CONTROLLERS, BUILTIN_NODES, NODELETS)
_TARGETS = sorted({target for catalog in _CATALOGS for target in catalog.values()})


@pytest.mark.parametrize("target", _TARGETS)
def test_every_target_can_be_imported(target: str) -> None:
    module, _, name = target.partition(":")

    assert callable(getattr(import_module(module), name))


@pytest.mark.parametrize("package", sorted({package for package, _ in BUILTIN_NODES}))
def test_packages_with_stand_ins_are_found(package: str, tmp_path: Path) -> None:
    assert Packages({}, start=tmp_path).find_folder(package) is not None
