"""Sensors as a description states them; the room `sensors` makes them measure."""

from dataclasses import dataclass

from trundle.diagnostics import Source
from trundle.spatial import Pose

from .plugin import PluginTag


@dataclass(frozen=True, slots=True, kw_only=True)
class CameraOptics:
    """A pinhole camera looking along +x of its frame, y to the left, z up."""

    sensor_from_camera: Pose = Pose()
    horizontal_fov_rad: float = 1.047
    width_px: int = 320
    height_px: int = 240
    format: str = "R8G8B8"
    near_m: float = 0.1
    far_m: float = 100.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Sensor:
    """A sensor mounted on a link."""

    name: str
    type: str
    """SDF's word: camera, ray, imu, …"""
    at: Source
    link_from_sensor: Pose = Pose()
    update_rate_hz: float = 0.0
    """0: at every physics step."""
    always_on: bool = False
    visualize: bool = False
    topic: str = ""
    camera: CameraOptics | None = None
    """Set for cameras."""
    plugins: tuple[PluginTag, ...] = ()
