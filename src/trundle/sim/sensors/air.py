"""Barometers and Pitot tubes: static and dynamic air pressure."""

import math

from msgspec import Struct

from trundle.robots.model import AirPressure, AirSpeed, Atmosphere
from trundle.sim.simulation import Snapshot
from trundle.spatial import Pose, Vector3

from .live_sensor import LiveSensor, SensorMount
from .noise import NoiseSource

_GRAVITY = 9.80665
"""[m/s²] Standard gravity."""
_MOLAR_MASS = 0.0289644
"""Molar mass of dry air [kg/mol]."""
_GAS = 8.31446
"""Gas constant [J/(mol K)]."""
_EARTH = 6_356_766.0
"""Earth's radius in gz-sim's geopotential height [m]."""
_DENSEST = 100.0
"""Largest logarithm of the pressure ratio to ground level, far below the ground."""
_COLDEST = 1.0
"""Lower bound of the temperature [K]."""


class PressureReading(Struct, frozen=True, kw_only=True):
    """Pressure with its variance."""

    __module__ = "trundle"

    time_ns: int
    pressure: float
    """[Pa]; for an air speed sensor the dynamic pressure, negative for flow from behind."""
    variance: float
    """[Pa²]"""


class _PressureSensor(LiveSensor[PressureReading]):
    """Pressure sensor with noise."""

    def __init__(self, mount: SensorMount, *, air: Atmosphere) -> None:
        """Mount the sensor; see `LiveSensor`.

        Args:
            mount: model, link and sensor.
            air: the world's atmosphere.
        """
        super().__init__(mount)
        assert isinstance(mount.sensor.instrument, AirPressure | AirSpeed), f"{mount.sensor.name!r} reads no pressure"
        self.air = air
        self._variance = mount.sensor.instrument.pressure.stddev**2
        self._noise = NoiseSource(mount.sensor.instrument.pressure, mount.random)

    def pressure(self, snapshot: Snapshot) -> float:
        """Return the pressure without noise [Pa]."""
        raise NotImplementedError

    def measure(self, snapshot: Snapshot) -> PressureReading:
        """Measure the pressure."""
        pressure = self._noise.apply_to_value(self.pressure(snapshot), snapshot.time_ns)
        return PressureReading(time_ns=snapshot.time_ns, pressure=pressure, variance=self._variance)


class AirPressureSensor(_PressureSensor):
    """Barometer; the pressure falls with height."""

    def pressure(self, snapshot: Snapshot) -> float:
        """Return the static pressure without noise [Pa]."""
        settings = self.sensor.instrument
        assert isinstance(settings, AirPressure), f"{self.name!r} is no barometer"
        height = settings.reference_altitude + self.world_from_sensor(snapshot).position[2]
        return pressure_at(self.air, _geopotential(height))


class AirSpeedSensor(_PressureSensor):
    """Pitot tube along +x: ρ v² / 2 of the air flow along it."""

    wind: Vector3 = (0.0, 0.0, 0.0)
    """The world's wind [m/s]."""

    def pressure(self, snapshot: Snapshot) -> float:
        """Return the dynamic pressure without noise [Pa]."""
        world_from_sensor = self.world_from_sensor(snapshot)
        vx, vy, vz = (motion - wind for motion, wind in zip(self.velocity(snapshot), self.wind, strict=True))
        ahead, _, _ = Pose(quaternion=world_from_sensor.quaternion).inverse().transform_vector((vx, vy, vz))
        return 0.5 * density_at(self.air, world_from_sensor.position[2]) * ahead * abs(ahead)


def _geopotential(height: float) -> float:
    """Return the geopotential height [m] of a geometric height [m], as in gz-sim's barometer."""
    height = max(height, -_EARTH / 2.0)
    return height / (1.0 + height / _EARTH)


def pressure_at(air: Atmosphere, height: float) -> float:
    """Return the pressure [Pa] at a height [m], by the barometric formula for a constant temperature gradient."""
    if air.temperature_gradient == 0.0:
        log_ratio = -_GRAVITY * _MOLAR_MASS * height / (_GAS * air.temperature)
        return air.pressure * math.exp(min(log_ratio, _DENSEST))
    exponent = -_GRAVITY * _MOLAR_MASS / (_GAS * air.temperature_gradient)
    log_ratio = exponent * math.log(_temperature_at(air, height) / air.temperature)
    return air.pressure * math.exp(min(log_ratio, _DENSEST))


def density_at(air: Atmosphere, height: float) -> float:
    """Return the density [kg/m³] at a height [m], as an ideal gas."""
    return pressure_at(air, height) * _MOLAR_MASS / (_GAS * _temperature_at(air, height))


def _temperature_at(air: Atmosphere, height: float) -> float:
    return max(air.temperature + air.temperature_gradient * height, _COLDEST)
