"""The mapper by a pose graph: a loop of 60 m is closed, false loops are refused."""

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.navigation.laser_drive import ends, relative, scans, smooth_drive
from tests.navigation.mapping.corridors import Drive, drive, twin_rooms

from trundle.navigation.mapping import _mapping
from trundle.navigation.mapping.karto_settings import KartoSettings

NOTHING = np.zeros((0, 2))
HERE = (0.0, 0.0, 0.0)
SETTINGS: dict[str, Any] = {"scan_buffer_size": 25}
"""Karto's defaults, but for fewer scans before that one is matched with."""


class Steps(NamedTuple):
    motion: tuple[float, float, float]
    hits: NDArray[np.float64]
    misses: NDArray[np.float64]


@pytest.fixture(scope="module")
def ring() -> Drive:
    return drive()


@pytest.fixture(scope="module")
def closed(ring: Drive) -> _mapping.GraphSlam:
    """The ring mapped with loops."""
    return map_drive(ring, KartoSettings(**SETTINGS))


def steps(measured: Drive) -> Iterator[Steps]:
    last = measured.odometry[0]
    for odometry, hits, misses in zip(measured.odometry, measured.hits, measured.misses, strict=True):
        yield Steps(relative(odometry, last), hits, misses)
        last = odometry


def map_drive(measured: Drive, settings: KartoSettings) -> _mapping.GraphSlam:
    slam = _mapping.GraphSlam(settings.graph_options())
    for number, step in enumerate(steps(measured)):
        slam.process(step.motion, 0.1 * number, (0.0, 0.0), step.hits, step.misses)
    return slam


def draw(slam: _mapping.GraphSlam) -> NDArray[np.int8]:
    first_column, first_row, last_column, last_row = slam.seen()
    width, height = last_column - first_column + 1, last_row - first_row + 1
    return slam.draw(
        first_column=first_column, first_row=first_row, width=width, height=height, occupied_threshold=0.25
    )


def test_a_loop_of_60_m_is_closed(ring: Drive, closed: _mapping.GraphSlam) -> None:
    """In featureless corridors only the odometry tells how far the robot drove."""
    open_loop = map_drive(ring, KartoSettings(**SETTINGS, do_loop_closing=False))

    x, y, yaw = ring.poses[-1]
    assert math.dist(open_loop.pose[:2], (x, y)) > 1.0
    assert closed.loops >= 1
    assert closed.refused_loops == 0
    assert math.dist(closed.pose[:2], (x, y)) < 0.15
    assert abs(math.remainder(closed.pose[2] - yaw, math.tau)) < math.radians(1.0)


def test_the_same_scans_give_the_same_graph_and_map_to_the_byte(ring: Drive, closed: _mapping.GraphSlam) -> None:
    again = map_drive(ring, KartoSettings(**SETTINGS))

    assert again.poses().tobytes() == closed.poses().tobytes()
    assert again.constraints().tobytes() == closed.constraints().tobytes()
    assert draw(again).tobytes() == draw(closed).tobytes()


def test_a_loop_that_the_scans_between_contradict_is_refused() -> None:
    """Two rooms that look the same are 6 m apart."""
    settings = KartoSettings(
        minimum_travel_distance=0.1,
        scan_buffer_size=20,
        link_scan_maximum_distance=2.0,
        loop_search_maximum_distance=8.0,
        loop_search_space_dimension=14.0,
        loop_match_minimum_chain_size=3,
        loop_match_minimum_response_coarse=0.5,
    )
    rooms = twin_rooms()
    slam = map_drive(rooms, settings)

    assert slam.refused_loops > 0
    assert slam.loops == 0
    assert slam.pose == pytest.approx(rooms.poses[-1], abs=0.08)


def test_a_scan_is_used_after_enough_motion_turn_or_time() -> None:
    settings = KartoSettings(minimum_travel_distance=0.5, minimum_travel_heading=0.3)
    options = settings.graph_options()
    options.least_time, options.longest_time = 1.0, 20.0
    slam = _mapping.GraphSlam(options)
    hits = ends(scans([(1.0, 1.0, 0.0)])[0])

    def process(motion: tuple[float, float, float], time_s: float) -> bool:
        return slam.process(motion, time_s, (0.0, 0.0), hits, NOTHING)

    assert process(HERE, 0.0)
    assert not process((0.3, 0.0, 0.0), 2.0)
    assert process((0.3, 0.0, 0.0), 4.0)
    assert not process((0.6, 0.0, 0.0), 4.5)  # too soon
    assert process(HERE, 6.0)
    assert process((0.0, 0.0, 0.35), 8.0)
    assert not process(HERE, 27.0)
    assert process(HERE, 28.1)


def test_a_drive_is_followed_without_odometry() -> None:
    """Each scan is searched for where a constant velocity leads."""
    options = KartoSettings(minimum_travel_distance=0.3, scan_buffer_size=15).graph_options()
    options.matches_all, options.still_linear_noise, options.still_angular_noise = True, 0.05, 0.05
    slam = _mapping.GraphSlam(options)
    poses = smooth_drive(step_m=0.08)[:90]
    last, motion = HERE, HERE
    for number, ranges in enumerate(scans(poses)):
        slam.process(motion, 0.1 * number, (0.0, 0.0), ends(ranges), NOTHING)
        motion, last = relative(slam.pose, last), slam.pose

    assert slam.pose[:2] == pytest.approx(relative(poses[-1], poses[0])[:2], abs=0.08)


def test_a_graph_is_restored_and_the_robot_found_in_it(ring: Drive, closed: _mapping.GraphSlam) -> None:
    options = KartoSettings(loop_match_minimum_response_coarse=0.5).graph_options()
    options.extends_map = False
    slam = _mapping.GraphSlam(options)
    slam.restore(closed.poses(), closed.constraints(), *closed.scans())

    slam.set_pose((0.7, -0.4, 0.2))  # the robot is at (0, 0)
    slam.process(HERE, 0.0, (0.0, 0.0), ring.hits[0], ring.misses[0])

    assert slam.pose == pytest.approx((0.0, 0.0, 0.0), abs=0.03)
    assert len(slam.poses()) == len(closed.poses())
    assert draw(slam).tobytes() == draw(closed).tobytes()


def test_hostile_numbers_are_refused_or_change_nothing() -> None:
    slam = _mapping.GraphSlam(KartoSettings().graph_options())
    far = np.array([[1e300, 1e300], [math.nan, 0.0], [-math.inf, 1.0], [1e9, -1e9]])
    for number in range(4):
        slam.process((1e6 * number, 0.0, 1.0), float(number), (0.0, 0.0), far, far)
    slam.process(HERE, 10.0, (0.0, 0.0), NOTHING, NOTHING)
    assert np.isfinite(slam.poses()).all()
    with pytest.raises(ValueError, match="finite"):
        slam.process((math.nan, 0.0, 0.0), 0.0, (0.0, 0.0), NOTHING, NOTHING)
    with pytest.raises(ValueError, match="finite"):
        slam.process(HERE, math.nan, (0.0, 0.0), NOTHING, NOTHING)
    with pytest.raises(ValueError, match="400 million"):
        slam.draw(first_column=0, first_row=0, width=10**9, height=10**9, occupied_threshold=0.25)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({1: np.array([[0.0, 9.0, *[0.0] * 9]])}, "not there"),
        ({1: np.array([[0.0, math.nan, *[0.0] * 9]])}, "not there"),
        ({0: np.array([[0.0, 0.0, math.inf], [0.0, 0.0, 0.0]])}, "finite"),
        ({4: np.array([1, 10**12], dtype=np.int64)}, "do not fit"),
        ({4: np.array([-1, 1], dtype=np.int64)}, "do not fit"),
        ({2: np.zeros((1, 2))}, "has a scan"),
    ],
)
def test_a_damaged_graph_is_refused(change: dict[int, NDArray[np.float64]], message: str) -> None:
    counts = np.array([1, 1], dtype=np.int64)
    arrays = [
        np.zeros((2, 3)),
        np.zeros((0, 11)),
        np.zeros((2, 2)),
        np.ones((2, 2)),
        counts,
        np.ones((2, 2)),
        counts,
    ]
    for place, array in change.items():
        arrays[place] = array
    slam = _mapping.GraphSlam(KartoSettings().graph_options())
    with pytest.raises(ValueError, match=message):
        slam.restore(*arrays)
