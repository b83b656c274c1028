"""Sensors of the air: its pressure at rest, and what it exerts on what flies."""

import math

from msgspec import Struct

from trundle.model import AirPressure, AirSpeed, Atmosphere
from trundle.simulation import Snapshot
from trundle.spatial import Pose, Vector3

from .live_sensor import LiveSensor, SensorMount
from .noise import NoiseSource

_GRAVITY = 9.80665
"""[m/s²] Standard gravity."""
_MOLAR_MASS = 0.0289644
"""[kg/mol] Of dry air."""
_GAS = 8.31446
"""[J/(mol K)]"""
_EARTH = 6_356_766.0
"""[m] The radius that gz-sim reckons with."""
_DENSEST = 100.0
"""Logarithm of how much denser than at the ground air becomes below it."""
_COLDEST = 1.0
"""[K] Above where the air would be colder it is all the same."""


class PressureReading(Struct, frozen=True, kw_only=True):
    """A pressure."""

    time_ns: int
    pressure: float
    """[Pa]; of an air speed sensor what moving adds, negative from behind."""
    variance: float
    """[Pa²]"""


class _PressureSensor(LiveSensor[PressureReading]):
    """Reads a pressure, with noise."""

    def __init__(self, mount: SensorMount, *, air: Atmosphere) -> None:
        """Mount it; see `LiveSensor`.

        Args:
            mount: where it is.
            air: of the world.
        """
        super().__init__(mount)
        assert isinstance(mount.sensor.instrument, AirPressure | AirSpeed), f"{mount.sensor.name!r} reads no pressure"
        self.air = air
        self._variance = mount.sensor.instrument.pressure.stddev**2
        self._noise = NoiseSource(mount.sensor.instrument.pressure, mount.random)

    def pressure(self, snapshot: Snapshot) -> float:
        """What there is at this instant [Pa]."""
        raise NotImplementedError

    def measure(self, snapshot: Snapshot) -> PressureReading:
        """The pressure at this instant."""
        pressure = self._noise.apply_to_value(self.pressure(snapshot), snapshot.time_ns)
        return PressureReading(time_ns=snapshot.time_ns, pressure=pressure, variance=self._variance)


class AirPressureSensor(_PressureSensor):
    """A barometer in air that thins with height."""

    def pressure(self, snapshot: Snapshot) -> float:
        """What there is at this instant [Pa]."""
        settings = self.sensor.instrument
        assert isinstance(settings, AirPressure), f"{self.name!r} is no barometer"
        height = settings.reference_altitude + self.world_from_sensor(snapshot).position[2]
        return pressure_at(self.air, _geopotential(height))


class AirSpeedSensor(_PressureSensor):
    """A Pitot tube along +x: ρ v² / 2 of the air that comes from ahead."""

    wind: Vector3 = (0.0, 0.0, 0.0)
    """Of the world [m/s]."""

    def pressure(self, snapshot: Snapshot) -> float:
        """What moving adds at this instant [Pa]."""
        world_from_sensor = self.world_from_sensor(snapshot)
        vx, vy, vz = (own - air for own, air in zip(self.velocity(snapshot), self.wind, strict=True))
        ahead, _, _ = Pose(quaternion=world_from_sensor.quaternion).inverse().transform_vector((vx, vy, vz))
        return 0.5 * density_at(self.air, world_from_sensor.position[2]) * ahead * abs(ahead)


def _geopotential(height: float) -> float:
    """The height [m] that takes as much work where gravity does not fall off, as gz-sim's barometer reckons it."""
    height = max(height, -_EARTH / 2.0)
    return height / (1.0 + height / _EARTH)


def pressure_at(air: Atmosphere, height: float) -> float:
    """Pressure [Pa] at a height [m], by the barometric formula for air whose temperature changes evenly."""
    if air.temperature_gradient == 0.0:
        thinner = -_GRAVITY * _MOLAR_MASS * height / (_GAS * air.temperature)
        return air.pressure * math.exp(min(thinner, _DENSEST))
    exponent = -_GRAVITY * _MOLAR_MASS / (_GAS * air.temperature_gradient)
    thinner = exponent * math.log(_temperature_at(air, height) / air.temperature)
    return air.pressure * math.exp(min(thinner, _DENSEST))


def density_at(air: Atmosphere, height: float) -> float:
    """Density [kg/m³] at a height [m], of an ideal gas."""
    return pressure_at(air, height) * _MOLAR_MASS / (_GAS * _temperature_at(air, height))


def _temperature_at(air: Atmosphere, height: float) -> float:
    return max(air.temperature + air.temperature_gradient * height, _COLDEST)
