"""Contact sensors, also called bumpers."""

from collections import deque
from collections.abc import Callable

from msgspec import Struct

from trundle.physics import Contact, Contacts
from trundle.simulation import Simulation, Snapshot
from trundle.spatial import Pose, Vector3, Wrench

from .live_sensor import LiveSensor, SensorMount

MAX_STEPS = 100
"""Most steps in one reading, the latest; Gazebo's limit too."""


class ContactRecord(Struct, frozen=True, kw_only=True):
    """Contact point on the sensor's link."""

    time_ns: int
    """Time of the step."""
    own: str
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

    time_ns: int
    contacts: tuple[ContactRecord, ...]
    world_from_link: Pose = Pose()
    """Pose of the sensor's link."""


class ContactSensor(LiveSensor[ContactReading]):
    """Contact sensor: records the contacts of its link's collisions at every step."""

    has_history = True

    def __init__(self, mount: SensorMount, *, contacts: Callable[[frozenset[str]], Contacts]) -> None:
        """Mount a contact sensor; see `LiveSensor`.

        Args:
            mount: model, link and sensor.
            contacts: returns the last step's contacts of the named collisions.
        """
        super().__init__(mount)
        names = mount.sensor.contact_collisions or tuple(collision.name for collision in mount.link.collisions)
        self._own = frozenset(f"{mount.model.name}::{mount.link.name}::{name}" for name in names)
        self._contacts = contacts
        self._buffer = _ContactBuffer(self._record)
        self._recorded: deque[tuple[ContactRecord, ...]] = deque(maxlen=MAX_STEPS)

    def start(self, simulation: Simulation) -> None:
        """Register two hooks: recording at every step, reporting at the sensor's rate."""
        simulation.add_hook(self._buffer, enabled=self.enabled)
        super().start(simulation)

    def stop(self, simulation: Simulation) -> None:
        """Remove both hooks."""
        simulation.remove_hook(self._buffer)
        super().stop(simulation)

    def measure(self, snapshot: Snapshot) -> ContactReading:
        """Return the contacts of the last period; older ones fell into a time without listeners."""
        now_ns, period_ns = snapshot.time_ns, max(self.period_ns, 1)
        felt = [touch for step in self._recorded for touch in step]
        self._recorded.clear()
        return ContactReading(
            time_ns=now_ns,
            contacts=tuple(touch for touch in felt if 0 <= now_ns - touch.time_ns < period_ns),
            world_from_link=self.world_from_link(snapshot),
        )

    def _record(self, snapshot: Snapshot) -> None:
        touches = tuple(self._contact_record(contact, snapshot.time_ns) for contact in self._contacts(self._own))
        if touches:
            self._recorded.append(touches)

    def _contact_record(self, contact: Contact, time_ns: int) -> ContactRecord:
        """Return the contact from the side of the sensor's link."""
        first, second = contact.collisions
        own, other, sign = (second, first, 1.0) if second in self._own else (first, second, -1.0)

        def signed(vector: Vector3) -> Vector3:
            return (sign * vector[0], sign * vector[1], sign * vector[2])

        return ContactRecord(
            time_ns=time_ns,
            own=own,
            other=other,
            position=contact.position,
            normal=signed(contact.normal),
            depth=contact.depth,
            wrench=Wrench(signed(contact.force.force), signed(contact.force.torque)),
        )


class _ContactBuffer(Struct, frozen=True, eq=False):
    """Hook that records at every step, for a sensor with a lower rate."""

    after_step: Callable[[Snapshot], None]
