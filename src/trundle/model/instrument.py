"""What sensors other than cameras, rays and imus are set to."""

from typing import TypeAlias

from msgspec import Struct

from .noise import Noise


class LogicalCamera(Struct, frozen=True, kw_only=True):
    """Tells which models are in a pyramid along +x."""

    near_m: float = 0.0
    far_m: float = 1.0
    aspect_ratio: float = 1.0
    """Width over height."""
    horizontal_fov_rad: float = 1.0


class Sonar(Struct, frozen=True, kw_only=True):
    """Tells how near the nearest thing is in a cone along −z, as Gazebo has it, or in a ball."""

    geometry: str = "cone"
    """cone or sphere."""
    min_m: float = 0.0
    max_m: float = 1.0
    radius: float = 0.5
    """Of the cone's far end, or of the ball [m]."""


class Transceiver(Struct, frozen=True, kw_only=True):
    """A wireless transmitter or receiver."""

    essid: str = "wireless"
    frequency_mhz: float = 2442.0
    """Of a transmitter."""
    lowest_mhz: float = 2412.0
    """That a receiver hears."""
    highest_mhz: float = 2484.0
    gain_dbi: float = 2.5
    power_dbm: float = 14.5
    sensitivity_dbm: float = -90.0
    """What is weaker a receiver does not hear."""


class Altimeter(Struct, frozen=True, kw_only=True):
    """Tells height above where it started, and how fast that grows."""

    position: Noise = Noise()
    """[m]"""
    velocity: Noise = Noise()
    """[m/s]"""


class Magnetometer(Struct, frozen=True, kw_only=True):
    """Tells the world's magnetic field along its own axes."""

    field: tuple[Noise, Noise, Noise] = (Noise(), Noise(), Noise())
    """[T]"""


class AirPressure(Struct, frozen=True, kw_only=True):
    """Tells the pressure of still air."""

    reference_altitude: float = 0.0
    """Of the world's z = 0 above the ground of its atmosphere [m]."""
    pressure: Noise = Noise()
    """[Pa]"""


class AirSpeed(Struct, frozen=True, kw_only=True):
    """Tells the pressure of the air that meets it along +x."""

    pressure: Noise = Noise()
    """[Pa]"""


Instrument: TypeAlias = LogicalCamera | Sonar | Transceiver | Altimeter | Magnetometer | AirPressure | AirSpeed
