"""Seamless patterns from integer noise, which is the same on every machine."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

SIDE_PX = 256
PAINT = 256
"""Offset of greys from 0 to 255 outside the pattern: mortar, road markings."""
Field = NDArray[np.int64]
"""(256, 256) values from 0 to 255, or grey from `PAINT`; upper row first."""
Pattern = Callable[[int], Field]
"""Returns a pattern for a seed."""
_FULL = 256
_ROWS, _COLUMNS = np.indices((SIDE_PX, SIDE_PX))
_MASK = np.uint64(0xFFFFFFFF)


def noise(seed: int, columns: int, rows: int) -> Field:
    """Return smooth noise between random values on a lattice of that many cells, which repeats."""
    x, y = _COLUMNS * columns, _ROWS * rows
    left, top = x // SIDE_PX, y // SIDE_PX
    u, v = _smooth(x % SIDE_PX), _smooth(y % SIDE_PX)
    lattice = _random(seed, rows, columns)

    def at(row: Field, column: Field) -> Field:
        return lattice[row % rows, column % columns]

    upper = at(top, left) * (_FULL - u) + at(top, left + 1) * u
    lower = at(top + 1, left) * (_FULL - u) + at(top + 1, left + 1) * u
    return (upper * (_FULL - v) + lower * v) // (_FULL * _FULL)


def clouds(seed: int, columns: int = 4, rows: int = 4, octaves: int = 5) -> Field:
    """Return noise of several scales, each half as strong as the previous one."""
    total = np.zeros((SIDE_PX, SIDE_PX), dtype=np.int64)
    for octave in range(octaves):
        total += noise(seed + octave, columns << octave, rows << octave) << (octaves - octave)
    return total // ((2 << octaves) - 2)


def grass(seed: int) -> Field:
    """Return tufts of short blades."""
    return (clouds(seed, 6, 6, 3) + noise(seed + 7, 128, 64) + noise(seed + 8, 96, 128)) // 3


def asphalt(seed: int) -> Field:
    """Return fine grains."""
    return (2 * clouds(seed, 3, 3, 3) + 3 * noise(seed + 7, 128, 128)) // 5


def plaster(seed: int) -> Field:
    """Return a rolled wall."""
    return 128 + (clouds(seed, 8, 8, 4) - 128) // 3


def concrete(seed: int) -> Field:
    """Return clouds with grains."""
    return 128 + (clouds(seed, 3, 3, 6) + noise(seed + 9, 128, 128) // 4 - 160) // 2


def wood(seed: int) -> Field:
    """Return a plank whose grain runs upwards."""
    bent = (_COLUMNS * 10 + noise(seed, 3, 2) * 8 + noise(seed + 1, 6, 3) * 3) % SIDE_PX
    rings = np.abs(2 * bent - SIDE_PX)
    fibres = noise(seed + 2, 128, 8)
    return (3 * rings * noise(seed + 3, 6, 2) // 256 + 4 * fibres + 2 * clouds(seed + 4, 4, 2, 3)) // 8


def floor(seed: int) -> Field:
    """Return floor boards: eight side by side, of different shades, with staggered ends."""
    board = _COLUMNS // 32
    shift = _random(seed, 1, 8)[0][board]
    shade = _random(seed + 1, 2, 8)[(_ROWS + shift) % SIDE_PX // 128, board]
    boards = 20 + (3 * wood(seed + 2) + shade) // 4
    gap = (_COLUMNS % 32 == 0) | ((_ROWS + shift) % 128 == 0)
    return np.where(gap, boards // 3, np.minimum(boards, 255))


def pallet(seed: int) -> Field:
    """Return five boards with gaps."""
    board = _COLUMNS * 5 // SIDE_PX
    within = _COLUMNS * 5 % SIDE_PX
    shade = _random(seed, 1, 5)[0][board]
    return np.where(within < 28, 10, 20 + (3 * wood(seed + 1) + shade) // 5)


def bricks(seed: int) -> Field:
    """Return eight courses of four bricks, with mortar between them."""
    course = _ROWS // 32
    along = (_COLUMNS + 32 * (course % 2)) % SIDE_PX
    shade = _random(seed, 8, 4)[course, along // 64]
    stone = (90 + shade // 3 + clouds(seed + 1, 16, 16, 3) // 3) * 3 // 4
    mortar = (_ROWS % 32 < 3) | (along % 64 < 3)
    return np.where(mortar, PAINT + 150 + noise(seed + 2, 128, 128) // 8, stone)


def tiles(seed: int) -> Field:
    """Return four ceiling tiles with holes between metal bars."""
    bars = (_ROWS % 128 < 4) | (_COLUMNS % 128 < 4)
    holes = noise(seed, 64, 64) < 60
    return np.where(bars, PAINT + 235, np.where(holes, 90, 150 + noise(seed + 1, 96, 96) // 8))


def steps(seed: int) -> Field:
    """Return eight treads with a bright edge."""
    return np.minimum(concrete(seed) + np.where(_ROWS % 32 < 4, 70, 0) - 2 * (_ROWS % 32), 255)


def lanes(count: int, *, edges: bool = True) -> Pattern:
    """Return a road of lanes side by side, with dashes between them and lines at its edges."""

    def road(seed: int) -> Field:
        ground = asphalt(seed) // 2
        dashes = np.zeros((SIDE_PX, SIDE_PX), dtype=bool)
        for line in range(1, count):
            dashes |= (np.abs(_COLUMNS - line * SIDE_PX // count) < 2) & (_ROWS % 128 < 64)
        sides = (np.minimum(_COLUMNS, SIDE_PX - 1 - _COLUMNS) // 3 == 2) & edges
        return np.where(dashes | sides, PAINT + 200, ground)

    return road


def _smooth(t: Field) -> Field:
    """Return 3 t² − 2 t³ of values from 0 to 255, as 0 to 256."""
    return t * t * (3 * _FULL - 2 * t) // (_FULL * _FULL)


def _random(seed: int, rows: int, columns: int) -> Field:
    """Return (rows, columns) random values from 0 to 255: lowbias32 (Wellons 2018) of seed, row and column."""
    row, column = np.indices((rows, columns), dtype=np.uint64)
    x = (row * np.uint64(0x9E3779B1) + column * np.uint64(0x85EBCA77) + np.uint64(seed) * np.uint64(0xC2B2AE3D)) & _MASK
    for shift, factor in ((16, 0x7FEB352D), (15, 0x846CA68B)):
        x = ((x ^ (x >> np.uint64(shift))) * np.uint64(factor)) & _MASK
    return (x >> np.uint64(24)).astype(np.int64)
