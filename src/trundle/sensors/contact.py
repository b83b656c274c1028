"""Contact sensors, also called bumpers."""

from collections import deque
from collections.abc import Callable

from msgspec import Struct

from trundle.physics import Contact
from trundle.simulation import Simulation, Snapshot
from trundle.spatial import Pose, Vector3, Wrench

from .live_sensor import LiveSensor, SensorMount

MAX_STEPS = 100
"""That one reading tells of, the last ones: Gazebo keeps no more either."""


class ContactRecord(Struct, frozen=True, kw_only=True):
    """One point where something touches the sensor's link."""

    time_ns: int
    """Of the step that found it."""
    own: str
    """`model::link::collision` that feels."""
    other: str
    """What it touches."""
    position: Vector3
    """In the world [m]."""
    normal: Vector3
    """Into the sensor's link; unit, world axes."""
    depth: float
    """[m]"""
    wrench: Wrench
    """On the sensor's link at that point, world axes."""


class ContactReading(Struct, frozen=True, kw_only=True):
    """What touched in the steps since the reading before, step by step."""

    time_ns: int
    contacts: tuple[ContactRecord, ...]
    world_from_link: Pose = Pose()
    """Of the sensor's link."""


class ContactSensor(LiveSensor[ContactReading]):
    """Feels at every step what touches some of its link's collisions, or all of them."""

    def __init__(self, mount: SensorMount, *, contacts: Callable[[frozenset[str]], list[Contact]]) -> None:
        """Mount a contact sensor; see `LiveSensor`.

        Args:
            mount: where it is.
            contacts: what touched collisions of these names in the last step.
        """
        super().__init__(mount)
        names = mount.sensor.contact_collisions or tuple(collision.name for collision in mount.link.collisions)
        self._own = frozenset(f"{mount.model.name}::{mount.link.name}::{name}" for name in names)
        self._contacts = contacts
        self._buffer = _ContactBuffer(self._record)
        self._recorded: deque[tuple[ContactRecord, ...]] = deque(maxlen=MAX_STEPS)

    def start(self, simulation: Simulation) -> None:
        """Be called by a simulation: at every step to feel, and then at the sensor's rate to tell."""
        simulation.add_hook(self._buffer, enabled=self.enabled)
        super().start(simulation)

    def stop(self, simulation: Simulation) -> None:
        """Be called no more."""
        simulation.remove_hook(self._buffer)
        super().stop(simulation)

    def measure(self, snapshot: Snapshot) -> ContactReading:
        """What touched within the last period; what was felt before, nobody wanted to know then."""
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
        """As the sensor's own link has it."""
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
    """A hook of its own, for a sensor feels more often than it tells."""

    after_step: Callable[[Snapshot], None]
