"""Arrays of poses obey the algebra of single ones."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from trundle.spatial import Pose
from trundle.viewer.poses import composed, inverted, known, rows_of

_number = st.floats(-3.0, 3.0)
_poses = st.builds(Pose.from_rpy, _number, _number, _number, _number, _number, _number)


@given(_poses, _poses)
def test_rows_compose_as_poses_do(a_from_b: Pose, b_from_c: Pose) -> None:
    expected = rows_of([a_from_b @ b_from_c])

    assert composed(rows_of([a_from_b]), rows_of([b_from_c])) == pytest.approx(expected, abs=1e-9)


@given(_poses)
def test_a_pose_and_its_inverse_cancel(pose: Pose) -> None:
    rows = rows_of([pose])

    assert composed(rows, inverted(rows)) == pytest.approx(rows_of([Pose()]), abs=1e-9)


def test_a_row_with_a_gap_is_no_pose() -> None:
    rows = rows_of([Pose(), Pose()])
    rows[1, 4] = np.nan

    assert known(rows).tolist() == [True, False]
