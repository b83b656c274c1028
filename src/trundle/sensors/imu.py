"""Inertial measurement units."""

from dataclasses import dataclass

from trundle.model import ImuNoise
from trundle.simulation import Snapshot
from trundle.spatial import Pose, Quaternion, Vector3

from .mounted import NS, MountedSensor, Spot
from .noise import NoiseSource, disturbed


@dataclass(frozen=True, slots=True, kw_only=True)
class ImuReading:
    """What an imu felt."""

    time_ns: int
    orientation: Quaternion
    """reference_from_sensor, wxyz; the reference is the world unless the file names another."""
    angular_velocity: Vector3
    """In the sensor's frame [rad/s]."""
    linear_acceleration: Vector3
    """Specific force in the sensor's frame [m/s²]: +g upwards at rest, nothing in free fall."""


class ImuSensor(MountedSensor[ImuReading]):
    """Feels how its point of the link moves, as the mean over the time since its last reading."""

    def __init__(self, spot: Spot, *, gravity: Vector3, reference_from_world: Pose) -> None:
        """Mount an imu; see `MountedSensor`.

        Args:
            spot: where it is.
            gravity: of the world [m/s²].
            reference_from_world: turns orientations into the frame that they are told in.
        """
        super().__init__(spot)
        noise = spot.sensor.imu or ImuNoise()
        self._gravity = gravity
        self._reference_from_world = reference_from_world
        self._rates = [NoiseSource(each, spot.random) for each in noise.angular_velocity]
        self._accelerations = [NoiseSource(each, spot.random) for each in noise.linear_acceleration]
        self._before: tuple[int, Vector3] | None = None
        """When and with which velocity it last read."""

    def take(self, snapshot: Snapshot) -> ImuReading:
        """Read at this instant; the first reading knows no acceleration but gravity."""
        world_from_sensor = self.world_from_sensor(snapshot)
        _, _, _, wx, wy, wz = snapshot.twists[self.link_index].tolist()
        turning = (wx, wy, wz)
        felt = self._felt(snapshot.time_ns, self.velocity(snapshot))
        sensor_from_world = Pose(quaternion=world_from_sensor.quaternion).inverse()
        return ImuReading(
            time_ns=snapshot.time_ns,
            orientation=(self._reference_from_world @ world_from_sensor).quaternion,
            angular_velocity=disturbed(sensor_from_world.direction(turning), self._rates, snapshot.time_ns),
            linear_acceleration=disturbed(sensor_from_world.direction(felt), self._accelerations, snapshot.time_ns),
        )

    def _felt(self, time_ns: int, velocity: Vector3) -> Vector3:
        """Acceleration less gravity, world axes."""
        before, self._before = self._before, (time_ns, velocity)
        gx, gy, gz = self._gravity
        if before is None or time_ns <= before[0]:
            return (-gx, -gy, -gz)
        elapsed = (time_ns - before[0]) / NS
        ax, ay, az = ((now - then) / elapsed for now, then in zip(velocity, before[1], strict=True))
        return (ax - gx, ay - gy, az - gz)
