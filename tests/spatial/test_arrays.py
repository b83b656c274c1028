"""Operations on arrays of poses equal the operations on single poses."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

from trundle.spatial import (
    Pose,
    compose_rows,
    finite_rows,
    invert_rows,
    matrix_from_quaternion,
    pose_from_row,
    quaternion_from_matrix,
    rotate_vectors,
    rows_from_poses,
    transform_points,
)

_number = st.floats(-3.0, 3.0)
_poses = st.builds(Pose.from_rpy, _number, _number, _number, _number, _number, _number)


@given(_poses, _poses)
def test_rows_compose_like_poses(a_from_b: Pose, b_from_c: Pose) -> None:
    expected = rows_from_poses([a_from_b @ b_from_c])

    assert compose_rows(rows_from_poses([a_from_b]), rows_from_poses([b_from_c])) == pytest.approx(expected, abs=1e-9)


@given(_poses)
def test_a_pose_and_its_inverse_cancel(pose: Pose) -> None:
    rows = rows_from_poses([pose])

    assert compose_rows(rows, invert_rows(rows)) == pytest.approx(rows_from_poses([Pose()]), abs=1e-9)


def test_rows_with_nan_are_not_finite() -> None:
    rows = rows_from_poses([Pose(), Pose()])
    rows[1, 4] = np.nan

    assert finite_rows(rows).tolist() == [True, False]


@given(_poses)
def test_a_row_converts_back_to_its_pose(pose: Pose) -> None:
    assert pose_from_row(rows_from_poses([pose])[0]) == pose


@given(_poses)
def test_matrices_and_quaternions_are_the_same_rotations(pose: Pose) -> None:
    matrix = matrix_from_quaternion(pose.quaternion)
    quaternion = np.array(quaternion_from_matrix(matrix))

    assert matrix @ (1.0, -2.0, 3.0) == pytest.approx(pose.transform_vector((1.0, -2.0, 3.0)), abs=1e-9)
    assert abs(quaternion @ pose.quaternion) == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize("half_turn", [(0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0), (0.0, 0.0, 0.0, 1.0)])
def test_matrices_of_half_turns_convert_back(half_turn: tuple[float, float, float, float]) -> None:
    """The trace is −1, so that dividing by w is impossible."""
    assert quaternion_from_matrix(matrix_from_quaternion(half_turn)) == pytest.approx(half_turn)


@given(_poses)
def test_points_are_transformed_and_directions_rotated(pose: Pose) -> None:
    points = np.array([[1.0, 2.0, 3.0], [0.0, -1.0, 0.5]])
    origin = np.array(pose.position)

    transformed = transform_points(pose, points)

    assert transformed == pytest.approx(
        np.array([pose.transform_point((x, y, z)) for x, y, z in points.tolist()]), abs=1e-9
    )
    assert rotate_vectors(pose, points) + origin == pytest.approx(transformed, abs=1e-9)
