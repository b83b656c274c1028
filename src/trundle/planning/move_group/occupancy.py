"""Occupancy of cubes by hits and by rays that pass, as octomap's tree has it at its finest level."""

import struct

import numpy as np
from numpy.typing import NDArray

_HIT, _MISS = 0.85, -0.4
"""Log-odds of a hit and of a ray that passes: probabilities 0.7 and 0.4, octomap's defaults."""
_LOWER, _UPPER = -2.0, 3.5
"""Clamped: probabilities 0.12 and 0.97."""
_DEPTH = 16
_CENTER = 1 << (_DEPTH - 1)
_MAX_CELLS = 2_000_000
_MAX_RAYS, _MAX_SAMPLES = 4000, 400
"""Rays of one update that free what they pass, and samples of each."""


class OccupancyGrid:
    """Log-odds of the cubes that were seen."""

    def __init__(self, resolution: float) -> None:
        """Begin with unknown space; `resolution`: length of the cubes [m]."""
        self.resolution = resolution
        self._keys: NDArray[np.int64] = np.zeros(0, dtype=np.int64)
        """Sorted codes of cells: interleaved bits of x, y, z, as the tree orders its leaves."""
        self._odds: NDArray[np.float32] = np.zeros(0, dtype=np.float32)

    def insert(self, origin: NDArray[np.float64], hits: NDArray[np.float64]) -> None:
        """Add rays from an origin (3,) to hits (n, 3) [m]."""
        hit = np.unique(self._codes(hits))
        rays = hits[:: max(1, len(hits) // _MAX_RAYS)]
        passed = np.setdiff1d(self._codes(_samples(origin, rays, self.resolution)), hit)
        self._add(hit, _HIT)
        self._add(passed, _MISS, only_known=True)

    def clear(self, points: NDArray[np.float64]) -> None:
        """Free the cubes of points (n, 3), such as those of the robot itself."""
        self._add(np.unique(self._codes(points)), _LOWER, only_known=True)

    def _codes(self, points: NDArray[np.float64]) -> NDArray[np.int64]:
        cells = np.floor(points / self.resolution).astype(np.int64) + _CENTER
        inside = np.all((cells >= 0) & (cells < 1 << _DEPTH), axis=1)
        return _interleaved(cells[inside])

    def _add(self, codes: NDArray[np.int64], change: float, *, only_known: bool = False) -> None:
        """Change cells; what was never hit is not stored as free."""
        if not only_known:
            new = np.setdiff1d(codes, self._keys, assume_unique=True)
            new = new[: max(0, _MAX_CELLS - len(self._keys))]
            keys = np.concatenate([self._keys, new])
            order = np.argsort(keys, kind="stable")
            self._keys = keys[order]
            self._odds = np.concatenate([self._odds, np.zeros(len(new), dtype=np.float32)])[order]
        if not len(self._keys):
            return
        at = np.minimum(np.searchsorted(self._keys, codes), len(self._keys) - 1)
        at_known = at[self._keys[at] == codes]
        self._odds[at_known] = np.clip(self._odds[at_known] + change, _LOWER, _UPPER)
        kept = self._odds > _LOWER
        self._keys, self._odds = self._keys[kept], self._odds[kept]

    def occupied(self) -> NDArray[np.int64]:
        """Return the sorted codes of the occupied cells."""
        return self._keys[self._odds > 0.0]

    def binary(self) -> NDArray[np.int8]:
        """Return octomap's binary tree of the occupied cells; all else is unknown."""
        codes = self.occupied()
        if not len(codes):
            return np.zeros(0, dtype=np.int8)
        out = bytearray()
        stack = [(0, len(codes), _DEPTH)]
        while stack:
            first, last, level = stack.pop()
            shift = 3 * (level - 1)
            children = codes[first:last] >> shift & 7
            edges = first + np.searchsorted(children, np.arange(9))
            bits, inner = 0, list[tuple[int, int, int]]()
            for child in range(8):
                low, high = int(edges[child]), int(edges[child + 1])
                if low == high:
                    continue
                if level == 1:
                    bits |= 2 << 2 * child
                else:
                    bits |= 3 << 2 * child
                    inner.append((low, high, level - 1))
            out += struct.pack("<H", bits)
            stack.extend(reversed(inner))
        return np.frombuffer(bytes(out), dtype=np.int8)


def _interleaved(cells: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return codes with the bits of x, y and z in turn, x lowest."""
    code = np.zeros(len(cells), dtype=np.int64)
    for bit in range(_DEPTH):
        for axis in range(3):
            code |= (cells[:, axis] >> bit & 1) << (3 * bit + axis)
    return code


def _samples(origin: NDArray[np.float64], hits: NDArray[np.float64], step: float) -> NDArray[np.float64]:
    """Return points along rays, half a cube apart, up to a cube before their ends."""
    if not len(hits):
        return np.zeros((0, 3))
    reach = np.linalg.norm(hits - origin, axis=1)
    count = int(min(np.ceil(reach.max() / step * 2.0), _MAX_SAMPLES))
    shares = np.linspace(0.0, 1.0, max(count, 2), endpoint=False)
    ends = np.maximum(0.0, 1.0 - step / np.maximum(reach, step))
    points = origin + (hits - origin)[:, None, :] * (shares[None, :] * ends[:, None])[:, :, None]
    return points.reshape(-1, 3)
