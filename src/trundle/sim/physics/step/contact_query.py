"""Contacts of all or some collisions, awake or asleep."""

from collections.abc import Callable

import mujoco
import numpy as np
from numpy.typing import NDArray

from ..compile.compiled_world import CompiledWorld
from .contact import Contacts, contacts_of
from .engine_snapshot import ScratchEngine

_Mask = NDArray[np.bool_]
_AWAKE = int(mujoco.mjtSleepState.mjS_AWAKE)


class ContactQuery:
    """Lookup of contacts; MuJoCo keeps none of sleeping bodies, so those are computed separately and cached."""

    def __init__(self, compiled: CompiledWorld, data: mujoco.MjData, scratch: ScratchEngine) -> None:
        self._compiled = compiled
        self._data = data
        self._scratch = scratch
        self._bodies = compiled.model.geom_bodyid
        self._geom_masks: dict[frozenset[str], _Mask] = {}
        """Names of collisions → mask of their geoms."""
        self._sleeping_contacts: tuple[bytes, Contacts] | None = None
        """Key of the sleeping bodies' state, and their contacts."""

    def contacts(self, among: frozenset[str] | None, asleep: Callable[[], NDArray[np.float64]] | None) -> Contacts:
        """Return every contact.

        Args:
            among: names of collisions, at least one of which is part of each contact; None: all.
            asleep: returns the engine's state, if anything sleeps.
        """
        marks = None if among is None else self._geom_mask(among)
        if asleep is None:
            return contacts_of(self._compiled, self._compiled.model, self._data, self._contact_indices(marks, None))
        awake = contacts_of(
            self._compiled, self._compiled.model, self._data, self._contact_indices(marks, self._awake())
        )
        return awake + self.sleeping_contacts(among, asleep)

    def sleeping_contacts(self, among: frozenset[str] | None, state: Callable[[], NDArray[np.float64]]) -> Contacts:
        """Return the contacts of sleeping bodies with each other and with fixed shapes.

        Args:
            among: names of collisions, at least one of which is part of each contact; None: all.
            state: returns the engine's state.
        """
        sleeping = self._sleeping(self._awake(), state)
        return sleeping if among is None else sleeping.among(among)

    def contacts_of_state(self, among: frozenset[str] | None, state: NDArray[np.float64]) -> Contacts:
        """Return the contacts of a state, for data without contacts; see `contacts`."""
        contacts = self._scratch.contacts(state, np.zeros(len(self._bodies), dtype=bool))
        return contacts if among is None else contacts.among(among)

    def _awake(self) -> _Mask:
        """Return (geoms,) mask of the geoms of awake bodies."""
        return self._data.body_awake[self._bodies] == _AWAKE

    def _geom_mask(self, collisions: frozenset[str]) -> _Mask:
        if collisions not in self._geom_masks:
            self._geom_masks[collisions] = np.array([name in collisions for name in self._compiled.geom_collisions])
        return self._geom_masks[collisions]

    def _contact_indices(self, marks: _Mask | None, awake: _Mask | None) -> NDArray[np.intp]:
        """Return indices of contacts with a marked geom and an awake one."""
        geoms = self._data.contact.geom
        chosen = np.ones(len(geoms), dtype=bool)
        for mask in (marks, awake):
            if mask is not None:
                chosen &= mask[geoms].any(axis=1)
        return np.flatnonzero(chosen)

    def _sleeping(self, awake: _Mask, state: Callable[[], NDArray[np.float64]]) -> Contacts:
        data = self._data
        asleep = data.body_awake != _AWAKE
        key = b"".join(array.tobytes() for array in (asleep, data.xpos[asleep], data.xquat[asleep]))
        if self._sleeping_contacts is None or key != self._sleeping_contacts[0]:
            self._sleeping_contacts = (key, self._scratch.contacts(state(), awake))
        return self._sleeping_contacts[1]
