"""Contact sensors, also called bumpers."""

from collections.abc import Iterator

import numpy as np
from msgspec import Struct

from trundle.sim.physics import ContactRecorder, Contacts
from trundle.sim.simulation import Simulation, Snapshot
from trundle.spatial import Pose, Vector3, Wrench

from .live_sensor import LiveSensor, SensorMount

MAX_STEPS = 100
"""Most steps in one reading, the latest; as in Gazebo."""


class ContactRecord(Struct, frozen=True, kw_only=True):
    """Contact point on the sensor's link."""

    time_ns: int
    """Time of the step."""
    collision: str
    """`model::link::collision` of the sensor."""
    other: str
    """`model::link::collision` in contact with it."""
    position: Vector3
    """Position in the world [m]."""
    normal: Vector3
    """Unit normal into the sensor's link, world axes."""
    depth: float
    """[m]"""
    wrench: Wrench
    """Wrench on the sensor's link at that point, world axes."""


class ContactReading(Struct, frozen=True, kw_only=True):
    """Contacts of the steps since the previous reading."""

    __module__ = "trundle"

    time_ns: int
    contacts: tuple[ContactRecord, ...]
    world_from_link: Pose = Pose()
    """Pose of the sensor's link."""


class ContactSensor(LiveSensor[ContactReading]):
    """Contact sensor: records the contacts of its link's collisions at every step, in C++."""

    has_history = True

    def __init__(self, mount: SensorMount) -> None:
        """Mount a contact sensor; see `LiveSensor`."""
        super().__init__(mount)
        names = mount.sensor.contact_collisions or tuple(collision.name for collision in mount.link.collisions)
        self._collisions = frozenset(f"{mount.model.name}::{mount.link.name}::{name}" for name in names)
        self._recorder = ContactRecorder(self._collisions, max_steps=MAX_STEPS)

    def start(self, simulation: Simulation) -> None:
        """Register the recorder, and a hook that reports at the sensor's rate."""
        simulation.add_recorder(self._recorder, enabled=self.enabled)
        super().start(simulation)

    def stop(self, simulation: Simulation) -> None:
        """Remove the recorder and the hook."""
        simulation.remove_recorder(self._recorder)
        super().stop(simulation)

    def measure(self, snapshot: Snapshot) -> ContactReading:
        """Return the contacts of the last period; older ones were recorded without listeners."""
        now_ns, period_ns = snapshot.time_ns, max(self.period_ns, 1)
        recorded = self._recorder.pop(after_ns=now_ns - period_ns, until_ns=now_ns)
        return ContactReading(
            time_ns=now_ns,
            contacts=tuple(record for times_ns, contacts in recorded for record in self._records(times_ns, contacts)),
            world_from_link=self.world_from_link(snapshot),
        )

    def _records(self, times_ns: list[int], contacts: Contacts) -> Iterator[ContactRecord]:
        """Yield the contacts as seen from the sensor's link."""
        sides = {pair: self._side(pair) for pair in set(contacts.collisions)}
        pairs = [sides[pair] for pair in contacts.collisions]
        signs = np.array([sign for _, _, sign in pairs]).reshape(-1, 1)
        columns = (
            contacts.positions,
            signs * contacts.normals,
            contacts.depths,
            signs * contacts.forces,
            signs * contacts.torques,
        )
        columns = [column.tolist() for column in columns]
        for time_ns, (collision, other, _), position, normal, depth, force, torque in zip(
            times_ns, pairs, *columns, strict=True
        ):
            yield ContactRecord(
                time_ns=time_ns,
                collision=collision,
                other=other,
                position=tuple(position),
                normal=tuple(normal),
                depth=depth,
                wrench=Wrench(tuple(force), tuple(torque)),
            )

    def _side(self, collisions: tuple[str, str]) -> tuple[str, str, float]:
        """Return the sensor's collision, the other one, and the sign of the force on the sensor's."""
        first, second = collisions
        return (second, first, 1.0) if second in self._collisions else (first, second, -1.0)
