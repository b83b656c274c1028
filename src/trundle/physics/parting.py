"""What begins inside something else comes out no faster than its surface's max_vel.

ODE limits the speed at which it corrects depth. MuJoCo's contacts have no such limit: what begins 10 cm deep would be
shot out at 6 m/s. So after a reset, a spawn or a leap, and as long as anything is deep, steps are taken one by one and
contacts are made to look no deeper than what comes out at that speed.
"""

import mujoco
import numpy as np
from numpy.typing import NDArray

from .index import CompiledWorld, GeomPair


class Parting:
    """Watches how deep things are in one another."""

    def __init__(self, compiled: CompiledWorld) -> None:
        self._step = compiled.model.opt.timestep
        speeds = {
            f"{model.name}::{link.name}::{collision.name}": max(collision.surface.max_vel, 0.0)
            for model in compiled.world.models
            for link in model.links
            for collision in link.collisions
        }
        self._speeds = np.array([speeds.get(name, np.inf) for name in compiled.geom_collisions])
        """(geoms,) max_vel [m/s]"""
        self.pairs: frozenset[GeomPair] = frozenset()
        """What is to be parted still."""

    def __bool__(self) -> bool:
        """Whether anything is."""
        return bool(self.pairs)

    def deep_pairs(self, data: mujoco.MjData) -> frozenset[GeomPair]:
        """What is deeper in one another than it may come out of at once."""
        return frozenset(_pair(data.contact.geom[i]) for i in self._deep(data).tolist())

    def hold_back(self, data: mujoco.MjData) -> bool:
        """Have contacts of what is to be parted look shallower, before they are solved; return whether any did."""
        contacts, most = data.contact, self._most(data)
        deep = [(i, pair) for i in self._deep(data).tolist() if (pair := _pair(contacts.geom[i])) in self.pairs]
        for i, _ in deep:
            contacts[i].dist = float(contacts.includemargin[i] - most[i])
        self.pairs = frozenset(pair for _, pair in deep)
        return bool(deep)

    def _deep(self, data: mujoco.MjData) -> NDArray[np.intp]:
        contacts = data.contact
        return np.flatnonzero(contacts.includemargin - contacts.dist > self._most(data))

    def _most(self, data: mujoco.MjData) -> NDArray[np.float64]:
        """(contacts,) depth that comes out at max_vel [m]; of soft contacts any, for depth is what holds them.

        An overdamped contact of time constant t and damping ratio r, solved at the step's end, creeps out at
        depth / (2 t r² + h).
        """
        contacts = data.contact
        speeds = self._speeds[contacts.geom].min(axis=1)
        time, ratio = contacts.solref[:, 0], contacts.solref[:, 1]
        return np.where(time > 0.0, speeds * (2 * time * ratio**2 + self._step), np.inf)


def _pair(geoms: NDArray[np.int32]) -> GeomPair:
    a, b = sorted(geoms.tolist())
    return (a, b)
