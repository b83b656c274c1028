"""Which contacts are of which pairs of shapes, for all contacts at once."""

from collections.abc import Iterable

import mujoco
import numpy as np
from numpy.typing import NDArray

from .index import GeomPair


class PairTable:
    """Some pairs of geoms, numbered in order."""

    def __init__(self, ngeom: int, pairs: Iterable[GeomPair]) -> None:
        self.pairs = sorted(pairs)
        self._ngeom = ngeom
        self._keys = np.array([low * ngeom + high for low, high in self.pairs], dtype=np.int64)

    def find(self, data: mujoco.MjData) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """The contacts between shapes of such a pair, and the number of the pair of each."""
        geoms = data.contact.geom.astype(np.int64)
        if not len(geoms) or not len(self._keys):
            return np.zeros(0, dtype=np.intp), np.zeros(0, dtype=np.intp)
        keys = geoms.min(axis=1) * self._ngeom + geoms.max(axis=1)
        places = np.minimum(np.searchsorted(self._keys, keys), len(self._keys) - 1)
        contacts = np.flatnonzero(self._keys[places] == keys)
        return contacts, places[contacts]
