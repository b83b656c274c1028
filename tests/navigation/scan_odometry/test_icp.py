"""Matches of scans in the small house against the true motion."""

import math

import numpy as np
import pytest
from tests.navigation.laser_drive import Pose, ends, relative, scans, smooth_drive

from trundle.navigation.scan_odometry import _icp
from trundle.navigation.scan_odometry.tracker import ScanTracker
from trundle.spatial import Pose as SpatialPose


def match(reference: Pose, pose: Pose, guess: Pose = (0.0, 0.0, 0.0), **more: object) -> _icp.IcpMatch:
    options = _icp.IcpOptions()
    options.max_iterations = 40
    for name, value in more.items():
        setattr(options, name, value)
    first, second = scans([reference, pose])
    return _icp.match_scans(options, ends(first), ends(second), guess)


@pytest.mark.parametrize("uses_lines", [True, False])
def test_the_motion_between_two_scans_is_found(uses_lines: bool) -> None:
    reference, pose = (1.0, 2.5, 0.3), (1.06, 2.47, 0.36)
    found = match(reference, pose, uses_lines=uses_lines)
    assert found.is_valid
    assert found.pose == pytest.approx(relative(pose, reference), abs=0.01 if uses_lines else 0.03)
    assert found.error < 0.03
    assert 0.0 < math.sqrt(found.covariance[0]) < 0.01


def test_a_guess_helps_over_a_long_way() -> None:
    reference, pose = (1.0, 2.5, 0.3), (1.5, 2.7, 0.9)
    truth = relative(pose, reference)
    found = match(reference, pose, (truth[0] + 0.05, truth[1] - 0.05, truth[2] + 0.05))
    assert found.is_valid
    assert found.pose == pytest.approx(truth, abs=0.02)
    assert not match(reference, pose, (truth[0] + 0.05, truth[1], truth[2]), max_linear=0.01).is_valid


def test_too_few_points_match_nothing() -> None:
    options = _icp.IcpOptions()
    few, many = np.zeros((2, 2)), ends(scans([(1.0, 1.0, 0.0)])[0])
    wild = np.array([[math.nan, 0.0], [1e300, 1.0], [math.inf, math.inf]])
    for reference, scan in ((few, many), (many, few), (wild, many), (many, wild), (few[:0], few[:0])):
        assert not _icp.match_scans(options, reference, scan, (0.0, 0.0, 0.0)).is_valid
    with pytest.raises(ValueError, match="finite"):
        _icp.match_scans(options, many, many, (math.nan, 0.0, 0.0))


def test_a_tracker_follows_a_drive_through_the_house() -> None:
    """Without any prediction; the laser is 0.1 m before the robot's center.

    With eight seeds of the noise the heading drifts by 2.5 to 3.5 degrees over the 368 scans.
    """
    poses = smooth_drive()
    base_from_laser = SpatialPose((0.1, 0.0, 0.0))
    tracker = ScanTracker(_icp.IcpOptions(), keyframe_linear=0.1, keyframe_angular=math.radians(10.0))
    lasers = [(x + 0.1 * math.cos(yaw), y + 0.1 * math.sin(yaw), yaw) for x, y, yaw in poses]
    worst = worst_yaw = 0.0
    for pose, ranges in zip(poses, scans(lasers), strict=True):
        assert tracker.add(ends(ranges), base_from_laser, SpatialPose())
        x, y, yaw = relative(pose, poses[0])
        worst = max(worst, math.hypot(tracker.pose[0] - x, tracker.pose[1] - y))
        worst_yaw = max(worst_yaw, abs(math.remainder(tracker.pose[2] - yaw, math.tau)))
    assert worst < 0.2
    assert math.degrees(worst_yaw) < 5.0
