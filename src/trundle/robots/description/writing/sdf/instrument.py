"""Writer of settings of sensors other than cameras, rays, IMUs, GPS and force-torque sensors."""

from trundle.robots.model import (
    AirPressure,
    AirSpeed,
    Altimeter,
    Instrument,
    LogicalCamera,
    Magnetometer,
    Noise,
    Sonar,
    Transceiver,
)

from ..tag import Tag
from .camera import add_noise


def add_instrument(sensor: Tag, instrument: Instrument) -> None:
    """Append the element with the sensor's settings."""
    match instrument:
        case LogicalCamera():
            tag = sensor.add("logical_camera")
            tag.add("near", instrument.near_m)
            tag.add("far", instrument.far_m)
            tag.add("aspect_ratio", instrument.aspect_ratio)
            tag.add("horizontal_fov", instrument.horizontal_fov_rad)
        case Sonar():
            tag = sensor.add("sonar")
            tag.add("geometry", instrument.geometry)
            tag.add("min", instrument.min_m)
            tag.add("max", instrument.max_m)
            tag.add("radius", instrument.radius)
        case Transceiver():
            tag = sensor.add("transceiver")
            tag.add("essid", instrument.essid)
            tag.add("frequency", instrument.frequency_mhz)
            tag.add("min_frequency", instrument.lowest_mhz)
            tag.add("max_frequency", instrument.highest_mhz)
            tag.add("gain", instrument.gain_dbi)
            tag.add("power", instrument.power_dbm)
            tag.add("sensitivity", instrument.sensitivity_dbm)
        case Altimeter():
            tag = sensor.add("altimeter")
            _add_inner(tag, "vertical_position", instrument.position)
            _add_inner(tag, "vertical_velocity", instrument.velocity)
        case Magnetometer():
            add_axes(sensor.add("magnetometer"), instrument.field)
        case AirPressure():
            tag = sensor.add("air_pressure")
            tag.add("reference_altitude", instrument.reference_altitude)
            _add_inner(tag, "pressure", instrument.pressure)
        case AirSpeed():
            _add_inner(sensor.add("air_speed"), "pressure", instrument.pressure)


def add_axes(quantity: Tag, noises: tuple[Noise, Noise, Noise]) -> None:
    """Append the noise along x, y and z."""
    for axis, noise in zip("xyz", noises, strict=True):
        _add_inner(quantity, axis, noise)


def _add_inner(home: Tag, name: str, noise: Noise) -> None:
    add_noise(home.add_optional(name), noise)
