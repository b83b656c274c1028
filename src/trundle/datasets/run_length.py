"""Run lengths of masks, in the characters that COCO's tools read."""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from .annotation import Mask


def encode_mask(mask: NDArray[np.bool_]) -> Mask:
    """Encode a (height, width) mask."""
    height, width = mask.shape
    columns = np.flatnonzero(mask.any(axis=0))
    first, last = (int(columns[0]), int(columns[-1]) + 1) if len(columns) else (0, 0)
    flat = np.zeros((last - first) * height + 2, dtype=bool)  # with background before and after
    flat[1:-1] = mask[:, first:last].T.reshape(-1)
    changes = np.flatnonzero(flat[1:] != flat[:-1]) + first * height
    ends = [0, *changes.tolist(), height * width]
    counts = [after - before for before, after in pairwise(ends)]
    if counts[-1] == 0 and len(counts) > 1:
        counts.pop()
    return Mask(size=(height, width), counts=_characters(counts))


def _characters(counts: list[int]) -> str:
    """Return each run as its difference from the one two before, in groups of five bits, the least first."""
    found: list[str] = []
    for i, count in enumerate(counts):
        rest = count - counts[i - 2] if i > 2 else count
        while True:
            bits = rest & 0x1F
            rest >>= 5
            is_last = rest == (-1 if bits & 0x10 else 0)
            found.append(chr((bits if is_last else bits | 0x20) + 48))
            if is_last:
                break
    return "".join(found)


def decode_mask(mask: Mask) -> NDArray[np.bool_]:
    """Return the (height, width) mask."""
    counts: list[int] = []
    number = shift = 0
    for character in mask.counts:
        code = ord(character) - 48
        number |= (code & 0x1F) << shift
        shift += 5
        if not code & 0x20:
            if code & 0x10:
                number |= -1 << shift
            counts.append(number + (counts[-2] if len(counts) > 2 else 0))
            number = shift = 0
    height, width = mask.size
    values = np.arange(len(counts)) % 2 == 1
    return np.repeat(values, counts).reshape(width, height).T
