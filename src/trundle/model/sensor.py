"""Sensors as a description states them; the room `sensors` makes them measure."""

from dataclasses import dataclass

from trundle.diagnostics import Source
from trundle.spatial import Pose

from .camera import CameraOptics
from .noise import Noise
from .plugin import PluginTag


@dataclass(frozen=True, slots=True, kw_only=True)
class ScanAxis:
    """The angles of a fan of rays."""

    samples: int = 1
    resolution: float = 1.0
    """Values reported for each ray, interpolated between them."""
    min_angle: float = 0.0
    """[rad]"""
    max_angle: float = 0.0
    """[rad]"""


@dataclass(frozen=True, slots=True, kw_only=True)
class RangeScan:
    """Rays from the sensor's origin, about its z axis and then up by its vertical angles; 0, 0 looks along +x."""

    horizontal: ScanAxis = ScanAxis()
    vertical: ScanAxis = ScanAxis()
    min_m: float = 0.0
    max_m: float = 0.0
    noise: Noise = Noise()


@dataclass(frozen=True, slots=True, kw_only=True)
class ImuNoise:
    """Noise about each axis of the sensor, x y z."""

    angular_velocity: tuple[Noise, Noise, Noise] = (Noise(), Noise(), Noise())
    """[rad/s]"""
    linear_acceleration: tuple[Noise, Noise, Noise] = (Noise(), Noise(), Noise())
    """[m/s²]"""


@dataclass(frozen=True, slots=True, kw_only=True)
class GpsNoise:
    """Noise of a position fix [m]."""

    horizontal: Noise = Noise()
    vertical: Noise = Noise()


@dataclass(frozen=True, slots=True, kw_only=True)
class ForceTorque:
    """How what a joint carries is told."""

    frame: str = "child"
    """Whose axes: child, parent or sensor."""
    parent_to_child: bool = False
    """What the parent does to the child; else what the child does to the parent."""


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
    cameras: tuple[CameraOptics, ...] = ()
    """One for cameras of every kind, several for a multicamera."""
    scan: RangeScan | None = None
    """Set for ray sensors and lidars."""
    imu: ImuNoise | None = None
    """Set for imus."""
    gps: GpsNoise | None = None
    """Set for gps and navsat sensors."""
    force_torque: ForceTorque | None = None
    """Set for force_torque sensors, which sit on joints."""
    touching: tuple[str, ...] | None = None
    """Set for contact sensors: the collisions of the link that feel; none named stands for all."""
    plugins: tuple[PluginTag, ...] = ()
