"""Receivers of satellite navigation."""

import math

from msgspec import Struct

from trundle.model import GpsNoise, Noise, SphericalCoordinates
from trundle.simulation import Snapshot
from trundle.spatial import Vector3

from .live_sensor import LiveSensor, SensorMount
from .noise import NoiseSource, apply_noise

DEFAULT_RATE_HZ = 10.0
"""Of a receiver whose update_rate is 0."""
_FARTHEST = 1e15
"""[m] Nobody asks for the latitude of what is farther away."""
_AXIS = 6378137.0
"""[m] WGS84's equatorial radius."""
_FLATTENING = 1 / 298.257223563
_E2 = _FLATTENING * (2 - _FLATTENING)
"""Eccentricity, squared."""


class GpsReading(Struct, frozen=True, kw_only=True):
    """A fix on WGS84."""

    time_ns: int
    latitude_deg: float
    longitude_deg: float
    altitude: float
    """Above the ellipsoid [m]."""


class GpsSensor(LiveSensor[GpsReading]):
    """Knows where its point of the link is on Earth, by the world's spherical coordinates."""

    def __init__(self, mount: SensorMount, *, origin: SphericalCoordinates) -> None:
        """Mount a receiver; see `LiveSensor`.

        Args:
            mount: where it is.
            origin: where the world's origin is.
        """
        super().__init__(mount, default_rate_hz=DEFAULT_RATE_HZ)
        noise = mount.sensor.gps or GpsNoise()
        self.variances = (_variance(noise.horizontal), _variance(noise.vertical))
        """Horizontal and vertical [m²]."""
        self._origin = origin
        self._noise = [NoiseSource(each, mount.random) for each in (noise.horizontal, noise.horizontal, noise.vertical)]

    def measure(self, snapshot: Snapshot) -> GpsReading:
        """A fix at this instant."""
        place = self.world_from_link(snapshot).transform_point(self.sensor.link_from_sensor.position)
        x, y, z = (
            min(max(value, -_FARTHEST), _FARTHEST) for value in apply_noise(place, self._noise, snapshot.time_ns)
        )
        latitude, longitude, altitude = geodetic(self._origin, (x, y, z))
        return GpsReading(time_ns=snapshot.time_ns, latitude_deg=latitude, longitude_deg=longitude, altitude=altitude)


def geodetic(origin: SphericalCoordinates, place: Vector3) -> Vector3:
    """Latitude [deg], longitude [deg] and height above WGS84's ellipsoid [m] of a place in the world [m].

    The world's tangent plane at its origin is turned by the heading, put into Earth's own axes and read back by
    Bowring's formula, which is exact to a micrometre this near to the ground.
    """
    heading = math.radians(origin.heading_deg)
    x, y, up = place
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
