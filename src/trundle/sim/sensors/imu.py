"""Inertial measurement units."""

from msgspec import Struct

from trundle.robots.model import ImuNoise
from trundle.sim.simulation import Snapshot
from trundle.spatial import NS_PER_S, Pose, Quaternion, Vector3, cross

from .live_sensor import LiveSensor, SensorMount
from .noise import NoiseSource, apply_noise


class ImuReading(Struct, frozen=True, kw_only=True):
    """IMU reading."""

    __module__ = "trundle"

    time_ns: int
    orientation: Quaternion
    """reference_from_sensor, wxyz; the reference is the sensor's initial frame unless the file sets another."""
    angular_velocity: Vector3
    """In the sensor's frame [rad/s]."""
    linear_acceleration: Vector3
    """Specific force in the sensor's frame [m/s²]: +g upwards at rest, zero in free fall."""


class ImuSensor(LiveSensor[ImuReading]):
    """IMU at the sensor's point of the link.

    The link's linear acceleration at its centre of mass and its angular acceleration are means over the time since the
    last reading, as in Gazebo; the centripetal term is instantaneous, because a mean would rotate with the link.
    """

    has_history = True

    def __init__(self, mount: SensorMount, *, gravity: Vector3, reference_from_world: Pose) -> None:
        """Mount an IMU; see `LiveSensor`.

        Args:
            mount: model, link and sensor.
            gravity: the world's gravity [m/s²].
            reference_from_world: rotation of the orientation output.
        """
        super().__init__(mount)
        noise = mount.sensor.imu or ImuNoise()
        self._gravity = gravity
        self._reference_from_world = reference_from_world
        self._rates = [NoiseSource(axis, mount.random) for axis in noise.angular_velocity]
        self._accelerations = [NoiseSource(axis, mount.random) for axis in noise.linear_acceleration]
        self._link_from_com = mount.link.inertial.link_from_com.position
        self._last_velocity: tuple[int, Vector3, Vector3] | None = None
        """Time, velocity of the centre of mass and angular velocity at the last reading, world axes."""

    def set_reference(self, reference_from_world: Pose) -> None:
        """Set the frame of the orientation output."""
        self._reference_from_world = reference_from_world

    def measure(self, snapshot: Snapshot) -> ImuReading:
        """Measure; the first reading has no acceleration other than gravity."""
        world_from_sensor = self.world_from_sensor(snapshot)
        vx, vy, vz, wx, wy, wz = snapshot.twists[self.link_index].tolist()
        angular_velocity = (wx, wy, wz)
        specific_force = self._specific_force(snapshot, (vx, vy, vz), angular_velocity)
        sensor_from_world = Pose(quaternion=world_from_sensor.quaternion).inverse()
        return ImuReading(
            time_ns=snapshot.time_ns,
            orientation=(self._reference_from_world @ world_from_sensor).quaternion,
            angular_velocity=apply_noise(
                sensor_from_world.transform_vector(angular_velocity), self._rates, snapshot.time_ns
            ),
            linear_acceleration=apply_noise(
                sensor_from_world.transform_vector(specific_force), self._accelerations, snapshot.time_ns
            ),
        )

    def _specific_force(self, snapshot: Snapshot, velocity: Vector3, angular_velocity: Vector3) -> Vector3:
        """Return acceleration minus gravity, world axes; `velocity` is the velocity of the link's origin."""
        world_from_link = self.world_from_link(snapshot)
        com = world_from_link.transform_vector(self._link_from_com)
        speed = _sum(velocity, cross(angular_velocity, com))
        before, self._last_velocity = self._last_velocity, (snapshot.time_ns, speed, angular_velocity)
        gx, gy, gz = self._gravity
        if before is None or snapshot.time_ns <= before[0]:
            return (-gx, -gy, -gz)
        elapsed = (snapshot.time_ns - before[0]) / NS_PER_S
        arm = _difference(world_from_link.transform_vector(self.sensor.link_from_sensor.position), com)
        angular_acceleration = _difference(angular_velocity, before[2], elapsed)
        inwards = cross(angular_velocity, cross(angular_velocity, arm))
        acceleration = _sum(_difference(speed, before[1], elapsed), cross(angular_acceleration, arm), inwards)
        return _difference(acceleration, self._gravity)


def _sum(*vectors: Vector3) -> Vector3:
    x, y, z = (sum(parts) for parts in zip(*vectors, strict=True))
    return (x, y, z)


def _difference(first: Vector3, second: Vector3, scale: float = 1.0) -> Vector3:
    """Return (first − second) / scale, by component."""
    x, y, z = ((a - b) / scale for a, b in zip(first, second, strict=True))
    return (x, y, z)
