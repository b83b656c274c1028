"""Altimeters."""

from msgspec import Struct

from trundle.robots.model import Altimeter
from trundle.sim.simulation import Snapshot

from .live_sensor import LiveSensor, SensorMount
from .noise import NoiseSource


class AltimeterReading(Struct, frozen=True, kw_only=True):
    """Height and vertical velocity."""

    __module__ = "trundle"

    time_ns: int
    height: float
    """Height above the sensor's initial position, as in Gazebo [m]."""
    velocity: float
    """Upwards [m/s]."""


class AltimeterSensor(LiveSensor[AltimeterReading]):
    """Altimeter at the sensor's point of the link."""

    def __init__(self, mount: SensorMount, *, start_height: float) -> None:
        """Mount the sensor; see `LiveSensor`.

        Args:
            mount: model, link and sensor.
            start_height: height of the sensor when its model was spawned [m].
        """
        super().__init__(mount)
        assert isinstance(mount.sensor.instrument, Altimeter), f"{mount.sensor.name!r} is no altimeter"
        self._start = start_height
        self._height = NoiseSource(mount.sensor.instrument.position, mount.random)
        self._speed = NoiseSource(mount.sensor.instrument.velocity, mount.random)

    def measure(self, snapshot: Snapshot) -> AltimeterReading:
        """Measure height and vertical velocity."""
        return AltimeterReading(
            time_ns=snapshot.time_ns,
            height=self._height.apply_to_value(
                self.world_from_sensor(snapshot).position[2] - self._start, snapshot.time_ns
            ),
            velocity=self._speed.apply_to_value(self.velocity(snapshot)[2], snapshot.time_ns),
        )
