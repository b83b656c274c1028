"""Settings of sensors other than cameras, rays, IMUs, GPS and force-torque sensors."""

from typing import TypeAlias

from msgspec import Struct

from .noise import Noise


class LogicalCamera(Struct, frozen=True, kw_only=True):
    """Sensor that lists the models inside a pyramid along +x."""

    __module__ = "trundle"

    near_m: float = 0.0
    """Nearest distance at which models are seen [m]."""
    far_m: float = 1.0
    """Farthest distance at which models are seen [m]."""
    aspect_ratio: float = 1.0
    """Ratio of width to height."""
    horizontal_fov_rad: float = 1.0
    """Horizontal field of view [rad]."""


class Sonar(Struct, frozen=True, kw_only=True):
    """Range sensor with a cone along −z, as in Gazebo, or a sphere."""

    __module__ = "trundle"

    geometry: str = "cone"
    """cone or sphere."""
    min_m: float = 0.0
    """Shortest range [m]."""
    max_m: float = 1.0
    """Longest range [m], which a reading without an echo has, too."""
    radius: float = 0.5
    """Radius of the cone's far end, or of the sphere [m]."""


class Transceiver(Struct, frozen=True, kw_only=True):
    """A wireless transmitter or receiver."""

    __module__ = "trundle"

    essid: str = "wireless"
    """Name of a transmitter's network."""
    frequency_mhz: float = 2442.0
    """Frequency of a transmitter [MHz]."""
    lowest_mhz: float = 2412.0
    """Lower end of a receiver's band [MHz]."""
    highest_mhz: float = 2484.0
    """Upper end of a receiver's band [MHz]."""
    gain_dbi: float = 2.5
    """Gain of the antenna [dBi]."""
    power_dbm: float = 14.5
    """Power of a transmitter [dBm]."""
    sensitivity_dbm: float = -90.0
    """Weakest signal that a receiver detects [dBm]."""


class Altimeter(Struct, frozen=True, kw_only=True):
    """Sensor of the height above its starting point and of vertical velocity."""

    __module__ = "trundle"

    position: Noise = Noise()
    """Noise of the height [m]."""
    velocity: Noise = Noise()
    """Noise of the vertical velocity [m/s]."""


class Magnetometer(Struct, frozen=True, kw_only=True):
    """Sensor of the world's magnetic field in its own frame."""

    __module__ = "trundle"

    field: tuple[Noise, Noise, Noise] = (Noise(), Noise(), Noise())
    """Noise along the axes [T]."""


class AirPressure(Struct, frozen=True, kw_only=True):
    """Barometer: static air pressure."""

    __module__ = "trundle"

    reference_altitude: float = 0.0
    """Height of the world's z = 0 above the ground of its atmosphere [m]."""
    pressure: Noise = Noise()
    """Noise of the pressure [Pa]."""


class AirSpeed(Struct, frozen=True, kw_only=True):
    """Pitot sensor: dynamic pressure of the air along +x."""

    __module__ = "trundle"

    pressure: Noise = Noise()
    """Noise of the pressure [Pa]."""


Instrument: TypeAlias = LogicalCamera | Sonar | Transceiver | Altimeter | Magnetometer | AirPressure | AirSpeed
