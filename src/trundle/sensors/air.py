"""Sensors of the air: its pressure at rest, and what it exerts on what flies."""

import math
from dataclasses import dataclass

import numpy as np

from trundle.model import AirPressure, AirSpeed, Atmosphere, Link, Model, Sensor
from trundle.simulation import Snapshot
from trundle.spatial import Pose, Vector3

from .mounted import MountedSensor
from .noise import NoiseSource

_GRAVITY = 9.80665
"""[m/s²] Standard gravity."""
_MOLAR_MASS = 0.0289644
"""[kg/mol] Of dry air."""
_GAS = 8.31446
"""[J/(mol K)]"""
_COLDEST = 1.0
"""[K] Above where the air would be colder it is all the same."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PressureReading:
    """A pressure."""

    time_ns: int
    pressure: float
    """[Pa]; of an air speed sensor what moving adds, negative from behind."""
    variance: float
    """[Pa²]"""


class AirPressureSensor(MountedSensor[PressureReading]):
    """A barometer in air that thins with height."""

    def __init__(
        self,
        model: Model,
        link: Link,
        sensor: Sensor,
        *,
        link_index: int,
        air: Atmosphere,
        random: np.random.Generator,
    ) -> None:
        """Mount it; see `MountedSensor`.

        Args:
            model: whose it is.
            link: that carries it.
            sensor: with its air_pressure.
            link_index: of the link in `Snapshot.poses`.
            air: of the world.
            random: for its noise.
        """
        super().__init__(model, link, sensor, link_index=link_index)
        assert isinstance(sensor.instrument, AirPressure), f"{sensor.name!r} is no barometer"
        self._air = air
        self._settings = sensor.instrument
        self._noise = NoiseSource(sensor.instrument.pressure, random)

    def take(self, snapshot: Snapshot) -> PressureReading:
        """The pressure at this instant."""
        height = self._settings.reference_altitude + self.world_from_sensor(snapshot).position[2]
        return PressureReading(
            time_ns=snapshot.time_ns,
            pressure=self._noise.disturb_one(pressure_at(self._air, height)),
            variance=self._settings.pressure.stddev**2,
        )


class AirSpeedSensor(MountedSensor[PressureReading]):
    """A Pitot tube along +x: ρ v² / 2 of the air that comes from ahead."""

    def __init__(
        self,
        model: Model,
        link: Link,
        sensor: Sensor,
        *,
        link_index: int,
        air: Atmosphere,
        wind: Vector3,
        random: np.random.Generator,
    ) -> None:
        """Mount it; see `AirPressureSensor`.

        Args:
            model: whose it is.
            link: that carries it.
            sensor: with its air_speed.
            link_index: of the link in `Snapshot.poses`.
            air: of the world.
            wind: of the world [m/s].
            random: for its noise.
        """
        super().__init__(model, link, sensor, link_index=link_index)
        assert isinstance(sensor.instrument, AirSpeed), f"{sensor.name!r} is no air speed sensor"
        self._air = air
        self._wind = wind
        self._variance = sensor.instrument.pressure.stddev**2
        self._noise = NoiseSource(sensor.instrument.pressure, random)

    def take(self, snapshot: Snapshot) -> PressureReading:
        """The pressure at this instant."""
        world_from_sensor = self.world_from_sensor(snapshot)
        vx, vy, vz = (own - air for own, air in zip(self.velocity(snapshot), self._wind, strict=True))
        ahead, _, _ = Pose(quaternion=world_from_sensor.quaternion).inverse().direction((vx, vy, vz))
        met = 0.5 * density_at(self._air, world_from_sensor.position[2]) * ahead * abs(ahead)
        return PressureReading(time_ns=snapshot.time_ns, pressure=self._noise.disturb_one(met), variance=self._variance)


def pressure_at(air: Atmosphere, height: float) -> float:
    """Pressure [Pa] at a height [m], by the barometric formula for air whose temperature changes evenly."""
    if air.temperature_gradient == 0.0:
        return air.pressure * math.exp(-_GRAVITY * _MOLAR_MASS * height / (_GAS * air.temperature))
    exponent = -_GRAVITY * _MOLAR_MASS / (_GAS * air.temperature_gradient)
    return air.pressure * (_temperature_at(air, height) / air.temperature) ** exponent


def density_at(air: Atmosphere, height: float) -> float:
    """Density [kg/m³] at a height [m], of an ideal gas."""
    return pressure_at(air, height) * _MOLAR_MASS / (_GAS * _temperature_at(air, height))


def _temperature_at(air: Atmosphere, height: float) -> float:
    return max(air.temperature + air.temperature_gradient * height, _COLDEST)
