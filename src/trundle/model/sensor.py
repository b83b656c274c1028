"""Sensors as a description states them; the room `sensors` makes them measure."""

from typing import TYPE_CHECKING

from msgspec import Struct

from trundle.diagnostics import Source
from trundle.spatial import Pose

if TYPE_CHECKING:
    from .camera import CameraOptics
    from .instrument import Instrument
    from .measuring import ForceTorque, GpsNoise, ImuNoise, RangeScan
    from .plugin import PluginTag

MEASURING = frozenset(
    {
        "air_pressure",
        "air_speed",
        "altimeter",
        "contact",
        "force_torque",
        "gps",
        "gpu_lidar",
        "gpu_ray",
        "imu",
        "lidar",
        "logical_camera",
        "magnetometer",
        "navsat",
        "ray",
        "rfid",
        "rfidtag",
        "sonar",
        "wireless_receiver",
        "wireless_transmitter",
    }
)
"""Types that need no picture; tags and transmitters are measured by others."""


class Sensor(Struct, frozen=True, kw_only=True):
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
    cameras: tuple["CameraOptics", ...] = ()
    """One for cameras of every kind, several for a multicamera."""
    scan: "RangeScan | None" = None
    """Set for ray sensors and lidars."""
    imu: "ImuNoise | None" = None
    """Set for imus."""
    gps: "GpsNoise | None" = None
    """Set for gps and navsat sensors."""
    force_torque: "ForceTorque | None" = None
    """Set for force_torque sensors, which sit on joints."""
    contact_collisions: tuple[str, ...] | None = None
    """Set for contact sensors: the collisions of the link that feel; none named stands for all."""
    instrument: "Instrument | None" = None
    """Set for sensors of other types that have settings."""
    plugins: tuple["PluginTag", ...] = ()
