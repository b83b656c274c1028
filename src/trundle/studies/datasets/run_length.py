"""COCO's compressed run-length encoding of masks."""

import numpy as np
from numpy.typing import NDArray

from .annotation import Mask

_BITS = 5
"""Bits of a number per character."""


def encode_mask(mask: NDArray[np.bool_], *, top: int, left: int, size: tuple[int, ...]) -> Mask:
    """Encode a mask from its non-empty part.

    Args:
        mask: (height, width) part of the mask; the rest is empty.
        top: first row of the part.
        left: first column of the part.
        size: height and width of the picture.
    """
    height, width = size
    columns = np.zeros((mask.shape[1], mask.shape[0] + 2), dtype=bool)  # with background above and below
    columns[:, 1:-1] = mask.T
    flat = columns.reshape(-1)
    column, row = np.divmod(np.flatnonzero(flat[1:] != flat[:-1]), columns.shape[1])
    changes = (left + column) * height + top + row
    joined = np.flatnonzero(changes[1:] == changes[:-1])  # a run that continues at the top of the next column
    changes = np.delete(changes, np.concatenate([joined, joined + 1]))
    counts = np.diff(changes, prepend=0, append=height * width)
    if counts[-1] == 0 and len(counts) > 1:
        counts = counts[:-1]
    return Mask(size=(height, width), counts=_characters(counts))


def _characters(counts: NDArray[np.int64]) -> str:
    """Return the difference of each run to the one two before, in groups of five bits, least significant first."""
    rest = counts.copy()
    rest[3:] -= counts[1:-2]
    is_left = np.ones(len(rest), dtype=bool)
    codes: list[NDArray[np.int64]] = []
    written: list[NDArray[np.bool_]] = []
    while is_left.any():
        bits = rest & 31
        rest >>= _BITS
        is_last = rest == np.where(bits & 16, -1, 0)
        codes.append(np.where(is_last, bits, bits | 32))
        written.append(is_left)
        is_left = is_left & ~is_last
    characters = (np.stack(codes, axis=1) + 48).astype(np.uint8)
    return characters[np.stack(written, axis=1)].tobytes().decode("ascii")


def decode_mask(mask: Mask) -> NDArray[np.bool_]:
    """Return the (height, width) mask."""
    counts: list[int] = []
    number = shift = 0
    for character in mask.counts:
        code = ord(character) - 48
        number |= (code & 0x1F) << shift
        shift += _BITS
        if not code & 0x20:
            if code & 0x10:
                number |= -1 << shift
            counts.append(number + (counts[-2] if len(counts) > 2 else 0))
            number = shift = 0
    height, width = mask.size
    values = np.arange(len(counts)) % 2 == 1
    return np.repeat(values, counts).reshape(width, height).T
