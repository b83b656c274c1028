"""Altimeters."""

from dataclasses import dataclass

import numpy as np

from trundle.model import Altimeter, Link, Model, Sensor
from trundle.simulation import Snapshot

from .mounted import MountedSensor
from .noise import NoiseSource


@dataclass(frozen=True, slots=True, kw_only=True)
class AltimeterReading:
    """How high it is."""

    time_ns: int
    height: float
    """Above where the sensor was when time began, as in Gazebo [m]."""
    velocity: float
    """Upwards [m/s]."""


class AltimeterSensor(MountedSensor[AltimeterReading]):
    """Tells height and vertical speed of its point of the link."""

    def __init__(
        self,
        model: Model,
        link: Link,
        sensor: Sensor,
        *,
        link_index: int,
        start_height: float,
        random: np.random.Generator,
    ) -> None:
        """Mount it; see `MountedSensor`.

        Args:
            model: whose it is.
            link: that carries it.
            sensor: with its altimeter.
            link_index: of the link in `Snapshot.poses`.
            start_height: where it was when its model came [m].
            random: for its noise.
        """
        super().__init__(model, link, sensor, link_index=link_index)
        assert isinstance(sensor.instrument, Altimeter), f"{sensor.name!r} is no altimeter"
        self._start = start_height
        self._height = NoiseSource(sensor.instrument.position, random)
        self._speed = NoiseSource(sensor.instrument.velocity, random)

    def take(self, snapshot: Snapshot) -> AltimeterReading:
        """How high it is at this instant."""
        return AltimeterReading(
            time_ns=snapshot.time_ns,
            height=self._height.disturb_one(self.world_from_sensor(snapshot).position[2] - self._start),
            velocity=self._speed.disturb_one(self.velocity(snapshot)[2]),
        )
