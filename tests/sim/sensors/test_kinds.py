"""The catalog of sensors is one."""

from trundle.robots.description.sdf.camera import CAMERA_TYPES
from trundle.sim.sensors import SIMULATED_CAMERAS


def test_every_camera_type_read_from_sdf_is_simulated() -> None:
    assert CAMERA_TYPES <= SIMULATED_CAMERAS
