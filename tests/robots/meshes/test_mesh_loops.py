"""Loops over faces in C++ equal their definitions in numpy."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

from trundle.robots.meshes import SupportGraph, component_labels, double_areas, fold_height, unique_rows

_FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
"""A tetrahedron's."""
_TETRAHEDRON = np.array([[-1.0, -1.0, -1.0], [3.0, -1.0, -1.0], [-1.0, 3.0, -1.0], [-1.0, -1.0, 3.0]])


@given(st.lists(st.tuples(*[st.sampled_from([-1.5, -0.0, 0.0, 2.0])] * 3), min_size=1), st.sampled_from("fd"))
def test_distinct_rows_are_those_of_numpy(rows: list[tuple[float, float, float]], kind: str) -> None:
    array = np.array(rows, dtype=kind)
    distinct, number = np.unique(array + 0.0, axis=0, return_inverse=True)

    first, numbers = unique_rows(array)

    assert np.array_equal(array[first], distinct)
    assert np.array_equal(numbers, number.reshape(-1))
    assert all(np.flatnonzero(numbers == i)[0] == index for i, index in enumerate(first.tolist()))


def test_rows_with_nan_are_distinct_and_the_last() -> None:
    first, numbers = unique_rows(np.array([[np.nan, 0, 0], [1, 0, 0], [np.nan, 0, 0], [1, 0, 0]]))
    assert first.tolist() == [1, 0, 2]
    assert numbers.tolist() == [1, 0, 2, 0]


def test_labels_are_the_smallest_points_of_their_components() -> None:
    faces = np.array([[6, 5, 4], [1, 2, 3], [4, 7, 8]])
    assert component_labels(10, faces).tolist() == [0, 1, 1, 1, 4, 4, 4, 4, 4, 9]


def test_areas_are_those_of_the_cross_product() -> None:
    assert double_areas(_TETRAHEDRON, _FACES).tolist() == pytest.approx([16.0, 16.0, 16.0 * 3**0.5, 16.0])


def test_a_convex_mesh_has_no_folds() -> None:
    assert fold_height(_TETRAHEDRON / 2, _FACES) == pytest.approx(0.0, abs=1e-12)
    assert fold_height(_TETRAHEDRON / 2, _FACES[:, ::-1].copy()) == np.inf  # inside out
    assert fold_height(_TETRAHEDRON / 2, _FACES[1:]) is None


def test_a_climb_ends_at_the_highest_point() -> None:
    graph = SupportGraph(_TETRAHEDRON, _FACES)
    directions = np.random.default_rng(2).normal(size=(50, 3))
    tops = graph.climb(directions, np.zeros(50, dtype=np.intp))
    assert np.array_equal(tops, (directions @ _TETRAHEDRON.T).argmax(axis=1))


def test_faces_of_other_points_are_refused() -> None:
    with pytest.raises(IndexError, match="a face names a point that is not there"):
        component_labels(3, _FACES)
    with pytest.raises(IndexError, match="no such start"):
        SupportGraph(_TETRAHEDRON, _FACES).climb(np.ones((1, 3)), np.array([4]))
    with pytest.raises(ValueError, match="a start for each direction"):
        SupportGraph(_TETRAHEDRON, _FACES).climb(np.ones((1, 3)), np.array([1, 2]))
