"""Controllers by type."""

import pytest

from trundle.gazebo.plugins.ros_control.catalog import CONTROLLERS, find_controller


@pytest.mark.parametrize("kind", CONTROLLERS)
def test_each_controller_is_in_its_module(kind: str) -> None:
    assert callable(find_controller(kind).create)
