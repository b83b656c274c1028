"""Inertial measurement units."""

from msgspec import Struct

from trundle.model import ImuNoise
from trundle.simulation import Snapshot
from trundle.spatial import NS_PER_S, Pose, Quaternion, Vector3, cross

from .live_sensor import LiveSensor, SensorMount
from .noise import NoiseSource, apply_noise


class ImuReading(Struct, frozen=True, kw_only=True):
    """What an imu felt."""

    time_ns: int
    orientation: Quaternion
    """reference_from_sensor, wxyz; the reference is the sensor at the start unless the file names another."""
    angular_velocity: Vector3
    """In the sensor's frame [rad/s]."""
    linear_acceleration: Vector3
    """Specific force in the sensor's frame [m/s²]: +g upwards at rest, nothing in free fall."""


class ImuSensor(LiveSensor[ImuReading]):
    """Feels how its point of the link moves.

    How the link's centre of mass speeds up and how its turning changes are means over the time since the last reading,
    as in Gazebo; the pull inwards is that of the instant, which a mean would turn with the link.
    """

    def __init__(self, mount: SensorMount, *, gravity: Vector3, reference_from_world: Pose) -> None:
        """Mount an imu; see `LiveSensor`.

        Args:
            mount: where it is.
            gravity: of the world [m/s²].
            reference_from_world: turns orientations into the frame that they are told in.
        """
        super().__init__(mount)
        noise = mount.sensor.imu or ImuNoise()
        self._gravity = gravity
        self._reference_from_world = reference_from_world
        self._rates = [NoiseSource(each, mount.random) for each in noise.angular_velocity]
        self._accelerations = [NoiseSource(each, mount.random) for each in noise.linear_acceleration]
        self._link_from_com = mount.link.inertial.link_from_com.position
        self._last_velocity: tuple[int, Vector3, Vector3] | None = None
        """When it last read; the centre of mass' velocity and the rate of turning at that instant, world axes."""

    def measure(self, snapshot: Snapshot) -> ImuReading:
        """Read at this instant; the first reading knows no acceleration but gravity."""
        world_from_sensor = self.world_from_sensor(snapshot)
        vx, vy, vz, wx, wy, wz = snapshot.twists[self.link_index].tolist()
        turning = (wx, wy, wz)
        felt = self._specific_force(snapshot, (vx, vy, vz), turning)
        sensor_from_world = Pose(quaternion=world_from_sensor.quaternion).inverse()
        return ImuReading(
            time_ns=snapshot.time_ns,
            orientation=(self._reference_from_world @ world_from_sensor).quaternion,
            angular_velocity=apply_noise(sensor_from_world.transform_vector(turning), self._rates, snapshot.time_ns),
            linear_acceleration=apply_noise(
                sensor_from_world.transform_vector(felt), self._accelerations, snapshot.time_ns
            ),
        )

    def _specific_force(self, snapshot: Snapshot, velocity: Vector3, turning: Vector3) -> Vector3:
        """Acceleration less gravity, world axes; velocity is that of the link's origin."""
        world_from_link = self.world_from_link(snapshot)
        com = world_from_link.transform_vector(self._link_from_com)
        speed = _sum(velocity, cross(turning, com))
        before, self._last_velocity = self._last_velocity, (snapshot.time_ns, speed, turning)
        gx, gy, gz = self._gravity
        if before is None or snapshot.time_ns <= before[0]:
            return (-gx, -gy, -gz)
        elapsed = (snapshot.time_ns - before[0]) / NS_PER_S
        arm = _difference(world_from_link.transform_vector(self.sensor.link_from_sensor.position), com)
        hastening = _difference(turning, before[2], elapsed)
        inwards = cross(turning, cross(turning, arm))
        return _difference(_sum(_difference(speed, before[1], elapsed), cross(hastening, arm), inwards), self._gravity)


def _sum(*vectors: Vector3) -> Vector3:
    x, y, z = (sum(parts) for parts in zip(*vectors, strict=True))
    return (x, y, z)


def _difference(one: Vector3, other: Vector3, scale: float = 1.0) -> Vector3:
    """Their difference, divided by a scale."""
    x, y, z = ((a - b) / scale for a, b in zip(one, other, strict=True))
    return (x, y, z)
