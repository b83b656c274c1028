"""The catalog of sensors is one."""

from trundle.description.sdf.camera import SEEING
from trundle.sensors import SIMULATED


def test_every_camera_that_is_read_is_simulated() -> None:
    assert SEEING <= SIMULATED
