"""Force-torque sensors on joints."""

from collections.abc import Callable

from msgspec import Struct

from trundle.robots.model import ForceTorque, Joint
from trundle.sim.simulation import LinkHandle, Snapshot
from trundle.spatial import Pose, Vector3, Wrench

from .live_sensor import LiveSensor, SensorMount
from .noise import NoiseSource, apply_noise


class ForceTorqueReading(Struct, frozen=True, kw_only=True):
    """Wrench through a joint, at the joint."""

    __module__ = "trundle"

    time_ns: int
    wrench: Wrench
    """Wrench in the frame set in the sensor."""


class ForceTorqueSensor(LiveSensor[ForceTorqueReading]):
    """Force-torque sensor: the wrench between a joint's parent and child."""

    def __init__(
        self, mount: SensorMount, *, joint: Joint, parent: LinkHandle | None, reaction: Callable[[], Wrench]
    ) -> None:
        """Mount the sensor; see `LiveSensor`.

        Args:
            mount: model, link and sensor.
            joint: measured joint.
            parent: parent link of the joint; None: the world.
            reaction: returns the wrench of the parent on the child at the joint, world axes.
        """
        super().__init__(mount)
        self.settings = mount.sensor.force_torque or ForceTorque()
        self.joint = joint
        self.parent_name = joint.name
        self.link_from_sensor = joint.child_from_joint @ mount.sensor.link_from_sensor
        self._parent = parent
        self._reaction = reaction
        self._forces = [NoiseSource(noise, mount.random) for noise in self.settings.force]
        self._torques = [NoiseSource(noise, mount.random) for noise in self.settings.torque]

    def measure(self, snapshot: Snapshot) -> ForceTorqueReading:
        """Measure the joint's wrench."""
        on_child = self._reaction()
        sign = 1.0 if self.settings.parent_to_child else -1.0
        axes = Pose(quaternion=self._world_from_axes(snapshot).quaternion).inverse()

        def in_axes(vector: Vector3) -> Vector3:
            x, y, z = axes.transform_vector(vector)
            return (sign * x, sign * y, sign * z)

        now = snapshot.time_ns
        force = apply_noise(in_axes(on_child.force), self._forces, now)
        torque = apply_noise(in_axes(on_child.torque), self._torques, now)
        return ForceTorqueReading(time_ns=now, wrench=Wrench(force, torque))

    def _world_from_axes(self, snapshot: Snapshot) -> Pose:
        match self.settings.frame:
            case "parent":
                if self._parent is None:
                    return Pose()
                x, y, z, qw, qx, qy, qz = snapshot.poses[self._parent.index].tolist()
                return Pose((x, y, z), (qw, qx, qy, qz))
            case "sensor":
                return self.world_from_link(snapshot) @ self.link_from_sensor
            case _:
                return self.world_from_link(snapshot)
