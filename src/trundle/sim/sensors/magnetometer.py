"""Magnetometers."""

from msgspec import Struct

from trundle.robots.model import Magnetometer
from trundle.sim.simulation import Snapshot
from trundle.spatial import Pose, Vector3

from .live_sensor import LiveSensor, SensorMount
from .noise import NoiseSource, apply_noise


class MagnetometerReading(Struct, frozen=True, kw_only=True):
    """Magnetic field at the sensor."""

    __module__ = "trundle"

    time_ns: int
    field: Vector3
    """Field in the sensor's frame [T]."""


class MagnetometerSensor(LiveSensor[MagnetometerReading]):
    """Magnetometer: the world's uniform magnetic field in the sensor's frame."""

    def __init__(self, mount: SensorMount, *, world_field: Vector3) -> None:
        """Mount the sensor; see `LiveSensor`.

        Args:
            mount: model, link and sensor.
            world_field: uniform field in the world frame [T].
        """
        super().__init__(mount)
        assert isinstance(mount.sensor.instrument, Magnetometer), f"{mount.sensor.name!r} is no magnetometer"
        self._field = world_field
        self._noise = [NoiseSource(axis, mount.random) for axis in mount.sensor.instrument.field]

    def measure(self, snapshot: Snapshot) -> MagnetometerReading:
        """Measure the field."""
        world_from_sensor = self.world_from_link(snapshot) @ self.sensor.link_from_sensor
        field = Pose(quaternion=world_from_sensor.quaternion).inverse().transform_vector(self._field)
        return MagnetometerReading(time_ns=snapshot.time_ns, field=apply_noise(field, self._noise, snapshot.time_ns))
