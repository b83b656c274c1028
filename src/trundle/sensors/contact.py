"""Contact sensors, also called bumpers."""

from collections.abc import Callable
from dataclasses import dataclass

from trundle.physics import Contact
from trundle.simulation import Snapshot
from trundle.spatial import Vector3, Wrench

from .mounted import MountedSensor, Spot


@dataclass(frozen=True, slots=True, kw_only=True)
class Touch:
    """One point where something touches the sensor's link."""

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


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactReading:
    """What touched."""

    time_ns: int
    touches: tuple[Touch, ...]


class ContactSensor(MountedSensor[ContactReading]):
    """Feels what touches some of its link's collisions, or all of them."""

    def __init__(self, spot: Spot, *, contacts: Callable[[], list[Contact]]) -> None:
        """Mount a contact sensor; see `MountedSensor`.

        Args:
            spot: where it is.
            contacts: what touched what in the last step.
        """
        super().__init__(spot)
        names = spot.sensor.touching or tuple(collision.name for collision in spot.link.collisions)
        self._own = frozenset(f"{spot.model.name}::{spot.link.name}::{name}" for name in names)
        self._contacts = contacts

    def take(self, snapshot: Snapshot) -> ContactReading:
        """What touches now."""
        touches = [touch for contact in self._contacts() for touch in self._felt(contact)]
        return ContactReading(time_ns=snapshot.time_ns, touches=tuple(touches))

    def _felt(self, contact: Contact) -> list[Touch]:
        first, second = contact.collisions
        if second in self._own:
            return [_touch(contact, own=second, other=first, sign=1.0)]
        return [_touch(contact, own=first, other=second, sign=-1.0)] if first in self._own else []


def _touch(contact: Contact, *, own: str, other: str, sign: float) -> Touch:
    def signed(vector: Vector3) -> Vector3:
        return (sign * vector[0], sign * vector[1], sign * vector[2])

    return Touch(
        own=own,
        other=other,
        position=contact.position,
        normal=signed(contact.normal),
        depth=contact.depth,
        wrench=Wrench(signed(contact.force.force), signed(contact.force.torque)),
    )
