"""Run lengths of masks, against COCO's own tools."""

import numpy as np
import pytest
from hypothesis import given, strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from trundle.studies.datasets.annotation import Box2d, Mask
from trundle.studies.datasets.object_pixels import find_pixels
from trundle.studies.datasets.run_length import decode_mask, encode_mask

MASKS = arrays(np.bool_, array_shapes(min_dims=2, max_dims=2, max_side=40), elements=st.booleans())


def _encoded(mask: np.ndarray[tuple[int, int], np.dtype[np.bool_]]) -> Mask:
    return encode_mask(mask, top=0, left=0, size=mask.shape)


def test_a_mask_by_hand() -> None:
    """COCO counts down the columns: two pixels of background, one of the object, and so on."""
    mask = np.array([[0, 0], [0, 1], [1, 1]], dtype=bool)  # down the columns: 0 0 1, 0 1 1
    assert _encoded(mask).counts == "2111"  # the runs 2 1 1 2; the fourth is written as 2 − 1


@given(MASKS)
def test_an_encoded_mask_is_decoded_unchanged(mask: np.ndarray[tuple[int, int], np.dtype[np.bool_]]) -> None:
    assert np.array_equal(decode_mask(_encoded(mask)), mask)


@given(MASKS)
def test_cocos_tools_read_it(mask: np.ndarray[tuple[int, int], np.dtype[np.bool_]]) -> None:
    tools = pytest.importorskip("pycocotools.mask", reason="pycocotools is not installed")
    encoded = _encoded(mask)
    assert encoded.counts.encode() == tools.encode(np.asfortranarray(mask.astype(np.uint8)))["counts"]


@given(MASKS)
def test_the_box_around_the_pixels_is_enough(mask: np.ndarray[tuple[int, int], np.dtype[np.bool_]]) -> None:
    found = find_pixels(np.where(mask, 7, 3).astype(np.uint16), 7)
    if found is None:
        assert not mask.any()
        return
    rows, columns = np.nonzero(mask)
    assert found.box == Box2d(columns.min(), rows.min(), columns.max() + 1, rows.max() + 1)
    assert encode_mask(found.mask, top=found.top, left=found.left, size=mask.shape) == _encoded(mask)
