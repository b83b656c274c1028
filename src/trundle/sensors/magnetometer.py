"""Magnetometers."""

from dataclasses import dataclass

import numpy as np

from trundle.model import Link, Magnetometer, Model, Sensor
from trundle.simulation import Snapshot
from trundle.spatial import Pose, Vector3

from .mounted import MountedSensor
from .noise import NoiseSource, disturbed


@dataclass(frozen=True, slots=True, kw_only=True)
class MagnetometerReading:
    """The field where the sensor is."""

    time_ns: int
    field: Vector3
    """In the sensor's frame [T]."""


class MagnetometerSensor(MountedSensor[MagnetometerReading]):
    """Turns the world's one magnetic field into its own axes."""

    def __init__(
        self,
        model: Model,
        link: Link,
        sensor: Sensor,
        *,
        link_index: int,
        world_field: Vector3,
        random: np.random.Generator,
    ) -> None:
        """Mount it; see `MountedSensor`.

        Args:
            model: whose it is.
            link: that carries it.
            sensor: with its magnetometer.
            link_index: of the link in `Snapshot.poses`.
            world_field: the same everywhere [T].
            random: for its noise.
        """
        super().__init__(model, link, sensor, link_index=link_index)
        assert isinstance(sensor.instrument, Magnetometer), f"{sensor.name!r} is no magnetometer"
        self._field = world_field
        self._noise = [NoiseSource(each, random) for each in sensor.instrument.field]

    def take(self, snapshot: Snapshot) -> MagnetometerReading:
        """The field at this instant."""
        world_from_sensor = self.world_from_link(snapshot) @ self.sensor.link_from_sensor
        own = Pose(quaternion=world_from_sensor.quaternion).inverse().direction(self._field)
        return MagnetometerReading(time_ns=snapshot.time_ns, field=disturbed(own, self._noise))
