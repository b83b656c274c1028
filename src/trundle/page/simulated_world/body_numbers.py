"""Body numbers that stay the same while models are added and removed, unlike link indices."""

from collections.abc import Sequence
from itertools import count

import numpy as np
from numpy.typing import NDArray

_Array = NDArray[np.float64]
_ORIGIN = (0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0)


class BodyNumbers:
    """Number of each link by its name, and the poses by number."""

    def __init__(self) -> None:
        self._numbers: dict[str, int] = {}
        self._reserved: frozenset[int] = frozenset()
        """Numbers of the links that the last update removed; a page may still draw these links."""
        self._rows = np.zeros((0, 7))
        self._order = np.zeros(0, dtype=np.intp)

    def update(self, links: Sequence[str]) -> None:
        """Set the links, `model::link`, in the order of their indices."""
        before = frozenset(self._numbers.values())
        current = {name: self._numbers[name] for name in links if name in self._numbers}
        used = frozenset(current.values()) | before | self._reserved
        free = (number for number in count() if number not in used)
        self._numbers = {name: current[name] if name in current else next(free) for name in links}
        self._reserved = before - frozenset(self._numbers.values())
        self._order = np.array([self._numbers[name] for name in links], dtype=np.intp)
        added = max(self._numbers.values(), default=-1) + 1 - len(self._rows)
        if added > 0:
            self._rows = np.concatenate([self._rows, np.tile(_ORIGIN, (added, 1))])

    def __getitem__(self, link: str) -> int:
        """Number of a link, `model::link`."""
        return self._numbers[link]

    def rows(self, poses: _Array) -> _Array:
        """Return poses by body number from poses (links, 7) by link index; deleted links keep their last pose."""
        self._rows[self._order] = poses
        return self._rows
