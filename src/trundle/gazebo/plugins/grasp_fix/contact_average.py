"""Contacts between fingers and an object, averaged over steps."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from trundle.sim.physics import Contact
from trundle.sim.simulation import LinkHandle

_MIN_RATIO = 0.3
"""Minimum ratio of the weaker to the stronger of two opposing forces."""
_MIN_FORCE = 1e-4
"""Minimum force that holds an object [N]."""


@dataclass(slots=True)
class ContactAverage:
    """Contact of one finger collision with one object: sums over the steps in contact."""

    arm: str
    finger: LinkHandle
    object_link: LinkHandle
    steps: int = 0
    force: NDArray[np.float64] = field(default_factory=lambda: np.zeros(3))
    """(3,) Sum of each step's mean force on the object, world axes [N]."""
    point: NDArray[np.float64] = field(default_factory=lambda: np.zeros(3))
    """(3,) Sum of each step's mean contact point, in the finger's frame [m]."""
    object_origin: NDArray[np.float64] = field(default_factory=lambda: np.zeros(3))
    """(3,) Sum of the origins of the object's link, in the finger's frame [m]."""

    def add(self, forces: NDArray[np.float64], points: NDArray[np.float64]) -> None:
        """Add one step's contacts.

        Args:
            forces: (n, 3) forces on the object, world axes [N].
            points: (n, 3) contact points in the world [m].
        """
        finger_from_world = self.finger.pose.inverse()
        x, y, z = points.mean(axis=0).tolist()
        self.steps += 1
        self.force += forces.mean(axis=0)
        self.point += finger_from_world.transform_point((x, y, z))
        self.object_origin += finger_from_world.transform_point(self.object_link.pose.position)

    @property
    def mean_force(self) -> NDArray[np.float64]:
        """(3,) Mean force on the object, world axes [N]."""
        return self.force / self.steps

    def slip_distance(self) -> float:
        """Change of the distance between contact point and object's origin since the contact [m]."""
        point, origin = self.point / self.steps, self.object_origin / self.steps
        x, y, z = point.tolist()
        distance = math.dist(self.finger.pose.transform_point((x, y, z)), self.object_link.pose.position)
        return abs(float(np.linalg.norm(point - origin)) - distance)


def group_by_pair(
    contacts: Iterable[Contact], fingers: Mapping[str, object]
) -> dict[tuple[str, str], tuple[NDArray[np.float64], NDArray[np.float64]]]:
    """Group contacts by (object, finger) collision: (n, 3) forces on the object and (n, 3) points, in the world.

    Args:
        contacts: contacts of one step.
        fingers: collisions of the gripper; in a contact of two fingers the second counts as the finger.
    """
    groups: dict[tuple[str, str], list[tuple[Sequence[float], Sequence[float]]]] = {}
    for contact in contacts:
        first, second = contact.collisions
        if second in fingers:
            pair, sign = (first, second), -1.0
        else:
            pair, sign = (second, first), 1.0
        force = [sign * value for value in contact.force.force]
        groups.setdefault(pair, []).append((force, contact.position))
    return {
        pair: (np.array([force for force, _ in rows]), np.array([point for _, point in rows]))
        for pair, rows in groups.items()
    }


def forces_oppose(forces: Sequence[NDArray[np.float64]], min_angle_rad: float) -> bool:
    """True if the angle between two of the forces exceeds a limit, and neither force is much weaker than the other."""
    for a, b in combinations(forces, 2):
        strong, weak = sorted((float(np.linalg.norm(a)), float(np.linalg.norm(b))), reverse=True)
        if weak < _MIN_FORCE or weak < _MIN_RATIO * strong:
            continue
        cosine = float(np.clip(a @ b / (strong * weak), -1.0, 1.0))
        if math.acos(cosine) > min_angle_rad:
            return True
    return False
