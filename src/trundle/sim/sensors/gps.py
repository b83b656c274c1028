"""GPS receivers."""

import math

from msgspec import Struct

from trundle.robots.model import GpsNoise, Noise, SphericalCoordinates
from trundle.sim.simulation import Snapshot
from trundle.spatial import Vector3

from .live_sensor import LiveSensor, SensorMount
from .noise import NoiseSource, apply_noise

DEFAULT_RATE_HZ = 10.0
"""Update rate of a receiver whose update_rate is 0."""
_FARTHEST = 1e15
"""Largest coordinate that is converted [m]."""
_AXIS = 6378137.0
"""WGS84 equatorial radius [m]."""
_FLATTENING = 1 / 298.257223563
_E2 = _FLATTENING * (2 - _FLATTENING)
"""Squared eccentricity."""


class GpsReading(Struct, frozen=True, kw_only=True):
    """WGS84 position fix."""

    __module__ = "trundle"

    time_ns: int
    latitude_deg: float
    """North of the equator [degrees]."""
    longitude_deg: float
    """East of Greenwich [degrees]."""
    altitude: float
    """Altitude above the ellipsoid [m]."""


class GpsSensor(LiveSensor[GpsReading]):
    """GPS receiver at the sensor's point of the link, by the world's spherical coordinates."""

    def __init__(self, mount: SensorMount, *, origin: SphericalCoordinates) -> None:
        """Mount a receiver; see `LiveSensor`.

        Args:
            mount: model, link and sensor.
            origin: geographic position of the world's origin.
        """
        super().__init__(mount, default_rate_hz=DEFAULT_RATE_HZ)
        noise = mount.sensor.gps or GpsNoise()
        self.variances = (_variance(noise.horizontal), _variance(noise.vertical))
        """Horizontal and vertical variance [m²]."""
        self._origin = origin
        self._noise = [NoiseSource(axis, mount.random) for axis in (noise.horizontal, noise.horizontal, noise.vertical)]

    def measure(self, snapshot: Snapshot) -> GpsReading:
        """Measure a position fix."""
        position = self.world_from_link(snapshot).transform_point(self.sensor.link_from_sensor.position)
        x, y, z = (
            min(max(value, -_FARTHEST), _FARTHEST) for value in apply_noise(position, self._noise, snapshot.time_ns)
        )
        latitude, longitude, altitude = geodetic(self._origin, (x, y, z))
        return GpsReading(time_ns=snapshot.time_ns, latitude_deg=latitude, longitude_deg=longitude, altitude=altitude)


def geodetic(origin: SphericalCoordinates, position: Vector3) -> Vector3:
    """Return latitude [deg], longitude [deg] and height above the WGS84 ellipsoid [m] of a point in the world [m].

    The world's tangent plane at its origin is rotated by the heading, transformed to ECEF and converted by Bowring's
    formula, accurate to a micrometre near the ground.
    """
    heading = math.radians(origin.heading_deg)
    x, y, up = position
    east = x * math.cos(heading) - y * math.sin(heading)
    north = x * math.sin(heading) + y * math.cos(heading)
    latitude, longitude = math.radians(origin.latitude_deg), math.radians(origin.longitude_deg)
    sin_lat, cos_lat, sin_lon, cos_lon = (
        math.sin(latitude),
        math.cos(latitude),
        math.sin(longitude),
        math.cos(longitude),
    )
    normal = _AXIS / math.sqrt(1 - _E2 * sin_lat**2)
    radial = (normal + origin.elevation) * cos_lat + up * cos_lat - north * sin_lat
    ex = radial * cos_lon - east * sin_lon
    ey = radial * sin_lon + east * cos_lon
    ez = (normal * (1 - _E2) + origin.elevation) * sin_lat + north * cos_lat + up * sin_lat
    return _of_earth(ex, ey, ez)


def _of_earth(x: float, y: float, z: float) -> Vector3:
    polar = _AXIS * (1 - _FLATTENING)
    distance = math.hypot(x, y)
    theta = math.atan2(z * _AXIS, distance * polar)
    second = _E2 / (1 - _E2)
    latitude = math.atan2(z + second * polar * math.sin(theta) ** 3, distance - _E2 * _AXIS * math.cos(theta) ** 3)
    normal = _AXIS / math.sqrt(1 - _E2 * math.sin(latitude) ** 2)
    height = distance * math.cos(latitude) + (z + _E2 * normal * math.sin(latitude)) * math.sin(latitude) - normal
    return math.degrees(latitude), math.degrees(math.atan2(y, x)), height


def _variance(noise: Noise) -> float:
    return noise.stddev**2
