"""Contacts of a simulation for its page."""

import numpy as np
from numpy.typing import NDArray

from trundle.sim.simulation import Simulation

from .body_numbers import BodyNumbers

MAX_CONTACTS = 2000
"""Limit of contacts in a message; those with the greatest forces are sent."""


class ContactRows:
    """Reads the contacts of one world."""

    def __init__(self, simulation: Simulation, bodies: BodyNumbers) -> None:
        """Map the geoms of a simulation to the body numbers of their links."""
        self._simulation = simulation
        links = (name.rpartition("::")[0] for name in simulation.engine.compiled.geom_collisions)
        self._bodies = np.array([bodies[link] if link else -1 for link in links], dtype=np.float64)
        """Number of the link of each geom."""

    def read(self) -> NDArray[np.float64]:
        """Return the contacts (N, 9) of the last step.

        Columns: both bodies, position in the world [m], force of the first on the second [N], depth [m].
        """
        contacts = self._simulation.contacts()
        rows = np.empty((len(contacts), 9))
        rows[:, :2] = self._bodies[contacts.rows[:, :2].astype(np.intp)]
        rows[:, 2:5], rows[:, 5:8], rows[:, 8] = contacts.positions, contacts.forces, contacts.depths
        if len(rows) <= MAX_CONTACTS:
            return rows
        strongest = np.argsort(-np.linalg.norm(rows[:, 5:8], axis=1), kind="stable")[:MAX_CONTACTS]
        return rows[np.sort(strongest)]
