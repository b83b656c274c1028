"""Settings of ray sensors, IMUs, GPS receivers and force-torque sensors."""

from msgspec import Struct

from trundle.spatial import Vector3

from .noise import Noise
from .visibility import EVERY_BIT


class ScanAxis(Struct, frozen=True, kw_only=True):
    """Horizontal or vertical angles of a ray scan."""

    __module__ = "trundle"

    samples: int = 1
    """Number of rays."""
    resolution: float = 1.0
    """Ratio of output values to samples; Gazebo interpolates between rays."""
    min_angle: float = 0.0
    """Angle of the first ray [rad]."""
    max_angle: float = 0.0
    """Angle of the last ray [rad]."""

    @property
    def values(self) -> int:
        """Number of output values."""
        return max(1, int(self.samples * self.resolution))


class RangeScan(Struct, frozen=True, kw_only=True):
    """Ray scan from the sensor's origin: horizontal angles about its z axis, vertical angles upwards; (0, 0) is +x."""

    __module__ = "trundle"

    horizontal: ScanAxis = ScanAxis()
    """Angles about z, counterclockwise."""
    vertical: ScanAxis = ScanAxis()
    """Angles upwards, one row of rays each."""
    min_m: float = 0.0
    """Shortest range [m]; nearer surfaces read −inf."""
    max_m: float = 0.0
    """Longest range [m]; farther surfaces read inf."""
    noise: Noise = Noise()
    """Noise of each range [m]."""
    visibility_mask: int = EVERY_BIT
    """Mask of gpu_ray sensors: they see the visuals whose flags share a bit with it."""


class OrientationReference(Struct, frozen=True, kw_only=True):
    """Reference frame of an IMU's orientation."""

    __module__ = "trundle"

    localization: str = "CUSTOM"
    """ENU, NED, NWU, GRAV_UP, GRAV_DOWN or CUSTOM."""
    custom_rpy: Vector3 = (0.0, 0.0, 0.0)
    """Roll, pitch and yaw of a CUSTOM frame in its parent [rad]."""
    parent_frame: str = ""
    """"world", or empty: the sensor's initial frame."""
    gravity_x: Vector3 = (1.0, 0.0, 0.0)
    """x axis of GRAV_UP, whose z points against gravity, and of GRAV_DOWN, whose z points along it."""
    gravity_parent_frame: str = ""
    """Frame of `gravity_x`: "world", or empty: the sensor's initial frame."""


class ImuNoise(Struct, frozen=True, kw_only=True):
    """Noise of an IMU about its x, y and z axes, and the reference frame of its orientation."""

    __module__ = "trundle"

    angular_velocity: tuple[Noise, Noise, Noise] = (Noise(), Noise(), Noise())
    """Noise of the angular velocity [rad/s]."""
    linear_acceleration: tuple[Noise, Noise, Noise] = (Noise(), Noise(), Noise())
    """Noise of the acceleration [m/s²]."""
    reference: OrientationReference | None = None
    """None: the sensor's initial frame."""


class GpsNoise(Struct, frozen=True, kw_only=True):
    """Noise of a position fix [m]."""

    __module__ = "trundle"

    horizontal: Noise = Noise()
    """Noise to the east and to the north [m]."""
    vertical: Noise = Noise()
    """Noise of the altitude [m]."""


class ForceTorque(Struct, frozen=True, kw_only=True):
    """Force-torque sensor on a joint: frame, direction and noise of its wrench."""

    __module__ = "trundle"

    frame: str = "child"
    """Frame of the wrench: child, parent or sensor."""
    parent_to_child: bool = False
    """True: wrench of the parent on the child; False: of the child on the parent."""
    force: tuple[Noise, Noise, Noise] = (Noise(), Noise(), Noise())
    """Noise along the axes of `frame` [N]."""
    torque: tuple[Noise, Noise, Noise] = (Noise(), Noise(), Noise())
    """Noise about the axes of `frame` [N·m]."""
