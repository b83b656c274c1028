"""What scans, points and poses of messages may hold."""

import struct

import numpy as np
import pytest

from trundle.navigation.pose_messages import is_place
from trundle.navigation.scan_messages import beam_ends, read_ranges
from trundle.ros import Messages

_SIGNALING_NAN = struct.pack("<I", 0x7FA00000)


def _scan(ranges: list[float], **fields: float) -> bytes:
    messages = Messages()
    values = {"angle_increment": 0.5, "range_max": float("inf"), "ranges": ranges, **fields}
    return bytes(messages.serialize(messages.new("sensor_msgs/LaserScan", values)))


def test_only_measured_beams_have_an_end() -> None:
    scan = Messages().deserialize(_scan([float("nan"), 2.0, float("inf"), 0.0]), "sensor_msgs/LaserScan")

    np.testing.assert_allclose(beam_ends(scan), [(2.0 * np.cos(0.5), 2.0 * np.sin(0.5))])


def test_a_signaling_nan_is_read_as_nan() -> None:
    data = _scan([7.25]).replace(struct.pack("<f", 7.25), _SIGNALING_NAN)

    ranges = read_ranges(Messages().deserialize(data, "sensor_msgs/LaserScan"))

    assert np.isnan(ranges).tolist() == [True]


@pytest.mark.parametrize("field", ["angle_min", "angle_increment", "range_min"])
def test_a_scan_without_finite_angles_is_refused(field: str) -> None:
    scan = Messages().deserialize(_scan([1.0], **{field: float("inf")}), "sensor_msgs/LaserScan")

    with pytest.raises(ValueError, match="not finite"):
        beam_ends(scan)


def test_places_are_finite_and_within_a_million_kilometers() -> None:
    assert [is_place((x, 0.0)) for x in (1e9, -1e10, float("inf"), float("nan"))] == [True, False, False, False]
