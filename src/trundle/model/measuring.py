"""Settings of rays, imus, satellite receivers and force-torque sensors."""

from msgspec import Struct

from trundle.spatial import Vector3

from .noise import Noise
from .visibility import EVERY_BIT


class ScanAxis(Struct, frozen=True, kw_only=True):
    """The angles of a fan of rays."""

    samples: int = 1
    resolution: float = 1.0
    """Values told for each sample; Gazebo interpolates between rays."""
    min_angle: float = 0.0
    """[rad]"""
    max_angle: float = 0.0
    """[rad]"""

    @property
    def values(self) -> int:
        """How many are told."""
        return max(1, int(self.samples * self.resolution))


class RangeScan(Struct, frozen=True, kw_only=True):
    """Rays from the sensor's origin, about its z axis and then up by its vertical angles; 0, 0 looks along +x."""

    horizontal: ScanAxis = ScanAxis()
    vertical: ScanAxis = ScanAxis()
    min_m: float = 0.0
    max_m: float = 0.0
    noise: Noise = Noise()
    visibility_mask: int = EVERY_BIT
    """For gpu_ray sensors: they see the visuals whose flags share a bit with it."""


class OrientationReference(Struct, frozen=True, kw_only=True):
    """The frame that an imu tells its orientation in."""

    localization: str = "CUSTOM"
    """ENU, NED, NWU, GRAV_UP, GRAV_DOWN or CUSTOM."""
    custom_rpy: Vector3 = (0.0, 0.0, 0.0)
    """Roll, pitch and yaw of a custom frame in its parent [rad]."""
    parent_frame: str = ""
    """world, or empty: the sensor's own frame at the start."""
    gravity_x: Vector3 = (1.0, 0.0, 0.0)
    """The x axis of GRAV_UP, whose z points against gravity, and of GRAV_DOWN, whose z points along it."""
    gravity_parent_frame: str = ""


class ImuNoise(Struct, frozen=True, kw_only=True):
    """Noise about each axis of the sensor, x y z, and the frame of its orientation."""

    angular_velocity: tuple[Noise, Noise, Noise] = (Noise(), Noise(), Noise())
    """[rad/s]"""
    linear_acceleration: tuple[Noise, Noise, Noise] = (Noise(), Noise(), Noise())
    """[m/s²]"""
    reference: OrientationReference | None = None
    """None: the sensor as it was at the start."""


class GpsNoise(Struct, frozen=True, kw_only=True):
    """Noise of a position fix [m]."""

    horizontal: Noise = Noise()
    vertical: Noise = Noise()


class ForceTorque(Struct, frozen=True, kw_only=True):
    """How what a joint carries is told."""

    frame: str = "child"
    """Whose axes: child, parent or sensor."""
    parent_to_child: bool = False
    """What the parent does to the child; else what the child does to the parent."""
    force: tuple[Noise, Noise, Noise] = (Noise(), Noise(), Noise())
    """Along the axes that are told [N]."""
    torque: tuple[Noise, Noise, Noise] = (Noise(), Noise(), Noise())
    """[N·m]"""
