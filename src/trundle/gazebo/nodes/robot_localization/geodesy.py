"""Places on the WGS 84 ellipsoid: UTM by Krüger's series, and local tangent planes.

Formulas and coefficients: Karney, "Transverse Mercator with an accuracy of a few nanometers" (2011), to fourth order.
"""

import math
import re
from typing import NamedTuple

_RADIUS_M, _FLATTENING = 6378137.0, 1.0 / 298.257223563
_SQUARED_ECCENTRICITY = _FLATTENING * (2.0 - _FLATTENING)
_ECCENTRICITY = math.sqrt(_SQUARED_ECCENTRICITY)
_N = _FLATTENING / (2.0 - _FLATTENING)
_SCALE, _FALSE_EASTING_M, _FALSE_NORTHING_M = 0.9996, 500_000.0, 10_000_000.0
_RECTIFYING_M = _SCALE * _RADIUS_M / (1.0 + _N) * (1.0 + _N**2 / 4.0 + _N**4 / 64.0)
_TO_GRID = (
    _N / 2 - 2 * _N**2 / 3 + 5 * _N**3 / 16 + 41 * _N**4 / 180,
    13 * _N**2 / 48 - 3 * _N**3 / 5 + 557 * _N**4 / 1440,
    61 * _N**3 / 240 - 103 * _N**4 / 140,
    49561 * _N**4 / 161280,
)
_FROM_GRID = (
    _N / 2 - 2 * _N**2 / 3 + 37 * _N**3 / 96 - _N**4 / 360,
    _N**2 / 48 + _N**3 / 15 - 437 * _N**4 / 1440,
    17 * _N**3 / 480 - 37 * _N**4 / 840,
    4397 * _N**4 / 161280,
)
_NEWTON_STEPS = 5
_ZONE = re.compile(r"(\d{1,2})\s*([C-HJ-NP-Xc-hj-np-x])")
_LEAST_LATITUDE, _HIGHEST_LATITUDE = -80.0, 84.0


class UtmZone(NamedTuple):
    """Zone of the grid, and its hemisphere."""

    number: int
    is_north: bool


class UtmPlace(NamedTuple):
    """A place in the grid of a zone."""

    easting_m: float
    northing_m: float
    convergence: float
    """Direction of grid north, clockwise from true north [rad]."""


def parse_zone(text: str) -> UtmZone:
    """Read a zone such as `17T`: its number and the letter of a latitude band.

    Raises:
        ValueError: there is no such zone.
    """
    match = _ZONE.match(text.strip())
    if match is None or not 1 <= int(match[1]) <= 60:
        raise ValueError(f"no UTM zone {text!r}; one is a number from 1 to 60 and a letter from C to X, such as 17T")
    return UtmZone(int(match[1]), match[2].upper() >= "N")


def zone_of(latitude: float, longitude: float) -> UtmZone:
    """Return the standard zone of a place [°], with the exceptions of Norway and Svalbard.

    Raises:
        ValueError: UTM does not reach there.
    """
    if not _LEAST_LATITUDE <= latitude <= _HIGHEST_LATITUDE or not math.isfinite(longitude):
        raise ValueError(f"UTM reaches from latitude −80 to 84, not to {latitude:g}; use_local_cartesian has no bounds")
    degrees = math.floor((longitude + 180.0) % 360.0)
    number = degrees // 6 % 60 + 1
    if 56.0 <= latitude < 64.0 and number == 31 and degrees >= 183:
        number = 32
    if latitude >= 72.0 and 180 <= degrees < 222:
        number = 31 + 2 * ((degrees - 180 + 3) // 12)
    return UtmZone(number, latitude >= 0.0)


def to_utm(latitude: float, longitude: float, zone: UtmZone) -> UtmPlace:
    """Project a place [°] onto a zone's grid.

    Raises:
        ValueError: it is a quarter of the earth or more from the zone.
    """
    turn = math.radians((longitude - _central_meridian(zone) + 180.0) % 360.0 - 180.0)
    if not abs(turn) < math.radians(80.0):
        raise ValueError(f"longitude {longitude:g} is too far from UTM zone {zone.number}")
    tangent = _conformal(math.tan(math.radians(latitude)))
    xi = math.atan2(tangent, math.cos(turn))
    eta = math.asinh(math.sin(turn) / math.hypot(tangent, math.cos(turn)))
    north, east, along, across = xi, eta, 1.0, 0.0
    for k, factor in enumerate(_TO_GRID, start=1):
        angle, argument = 2 * k * xi, 2 * k * eta
        north += factor * math.sin(angle) * math.cosh(argument)
        east += factor * math.cos(angle) * math.sinh(argument)
        along += 2 * k * factor * math.cos(angle) * math.cosh(argument)
        across += 2 * k * factor * math.sin(angle) * math.sinh(argument)
    convergence = math.atan(tangent / math.hypot(1.0, tangent) * math.tan(turn)) + math.atan2(across, along)
    southern_m = 0.0 if zone.is_north else _FALSE_NORTHING_M
    return UtmPlace(_FALSE_EASTING_M + _RECTIFYING_M * east, southern_m + _RECTIFYING_M * north, convergence)


def from_utm(easting_m: float, northing_m: float, zone: UtmZone) -> tuple[float, float]:
    """Return latitude and longitude [°] of a place in a zone's grid."""
    xi = (northing_m - (0.0 if zone.is_north else _FALSE_NORTHING_M)) / _RECTIFYING_M
    eta = (easting_m - _FALSE_EASTING_M) / _RECTIFYING_M
    north, east = xi, eta
    for k, factor in enumerate(_FROM_GRID, start=1):
        north -= factor * math.sin(2 * k * xi) * math.cosh(2 * k * eta)
        east -= factor * math.cos(2 * k * xi) * math.sinh(2 * k * eta)
    turn = math.atan2(math.sinh(east), math.cos(north))
    wanted = math.sin(north) / math.hypot(math.sinh(east), math.cos(north))
    tangent = wanted
    for _ in range(_NEWTON_STEPS):
        conformal = _conformal(tangent)
        slope = (1.0 - _SQUARED_ECCENTRICITY) * math.hypot(1.0, conformal) * math.hypot(1.0, tangent)
        slope /= 1.0 + (1.0 - _SQUARED_ECCENTRICITY) * tangent**2
        tangent += (wanted - conformal) / slope
    longitude = (_central_meridian(zone) + math.degrees(turn) + 180.0) % 360.0 - 180.0
    return math.degrees(math.atan(tangent)), longitude


class TangentPlane:
    """East, north and up [m] at an origin."""

    def __init__(self, latitude: float, longitude: float, altitude_m: float) -> None:
        """Take the origin [°], [m]."""
        phi, turn = math.radians(latitude), math.radians(longitude)
        self._origin = _geocentric(latitude, longitude, altitude_m)
        self._axes = (
            (-math.sin(turn), math.cos(turn), 0.0),
            (-math.sin(phi) * math.cos(turn), -math.sin(phi) * math.sin(turn), math.cos(phi)),
            (math.cos(phi) * math.cos(turn), math.cos(phi) * math.sin(turn), math.sin(phi)),
        )

    def forward(self, latitude: float, longitude: float, altitude_m: float) -> tuple[float, float, float]:
        """Return east, north and up [m] of a place [°], [m]."""
        offset = [a - b for a, b in zip(_geocentric(latitude, longitude, altitude_m), self._origin, strict=True)]
        east, north, up = (sum(a * b for a, b in zip(axis, offset, strict=True)) for axis in self._axes)
        return east, north, up

    def reverse(self, east_m: float, north_m: float, up_m: float) -> tuple[float, float, float]:
        """Return latitude, longitude [°] and altitude [m] of a place."""
        offsets = (east_m, north_m, up_m)
        x, y, z = (
            self._origin[i] + sum(offset * axis[i] for offset, axis in zip(offsets, self._axes, strict=True))
            for i in range(3)
        )
        distance = math.hypot(x, y)
        phi = math.atan2(z, distance * (1.0 - _SQUARED_ECCENTRICITY))
        for _ in range(_NEWTON_STEPS):
            radius = _RADIUS_M / math.sqrt(1.0 - _SQUARED_ECCENTRICITY * math.sin(phi) ** 2)
            phi = math.atan2(z + _SQUARED_ECCENTRICITY * radius * math.sin(phi), distance)
        radius = _RADIUS_M / math.sqrt(1.0 - _SQUARED_ECCENTRICITY * math.sin(phi) ** 2)
        altitude = (
            distance * math.cos(phi) + z * math.sin(phi) - radius * (1.0 - _SQUARED_ECCENTRICITY * math.sin(phi) ** 2)
        )
        return math.degrees(phi), math.degrees(math.atan2(y, x)), altitude


def _central_meridian(zone: UtmZone) -> float:
    return 6.0 * zone.number - 183.0


def _conformal(tangent: float) -> float:
    """Return the tangent of the conformal latitude from that of the geographic one."""
    sine = tangent / math.hypot(1.0, tangent)
    sigma = math.sinh(_ECCENTRICITY * math.atanh(_ECCENTRICITY * sine))
    return tangent * math.hypot(1.0, sigma) - sigma * math.hypot(1.0, tangent)


def _geocentric(latitude: float, longitude: float, altitude_m: float) -> tuple[float, float, float]:
    phi, turn = math.radians(latitude), math.radians(longitude)
    radius = _RADIUS_M / math.sqrt(1.0 - _SQUARED_ECCENTRICITY * math.sin(phi) ** 2)
    across = (radius + altitude_m) * math.cos(phi)
    up = (radius * (1.0 - _SQUARED_ECCENTRICITY) + altitude_m) * math.sin(phi)
    return across * math.cos(turn), across * math.sin(turn), up
