"""Sensors as described; the room `sensors` implements them."""

from typing import TYPE_CHECKING

from msgspec import Struct

from trundle.base.diagnostics import Source
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
"""Sensor types that need no image; tags and transmitters are detected by other sensors."""


class Sensor(Struct, frozen=True, kw_only=True):
    """Sensor mounted on a link."""

    name: str
    type: str
    """SDF type: camera, ray, imu, …"""
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
    """Set for contact sensors: collisions of the link that are monitored; empty: all."""
    instrument: "Instrument | None" = None
    """Set for sensors of other types that have settings."""
    plugins: tuple["PluginTag", ...] = ()
