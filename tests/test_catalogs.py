"""Catalogs: every class that one names by text is there."""

from importlib import import_module

import pytest

from trundle.nodes.catalog import BUILTIN_NODES, NODELETS
from trundle.plugins.catalog import BUILTIN, SENSOR_PLUGINS
from trundle.plugins.ros_control.catalog import CONTROLLERS

_CATALOGS = (BUILTIN, SENSOR_PLUGINS, CONTROLLERS, BUILTIN_NODES, NODELETS)
_TARGETS = sorted({target for catalog in _CATALOGS for target in catalog.values()})


@pytest.mark.parametrize("target", _TARGETS)
def test_every_target_can_be_imported(target: str) -> None:
    module, _, name = target.partition(":")

    assert callable(getattr(import_module(module), name))
