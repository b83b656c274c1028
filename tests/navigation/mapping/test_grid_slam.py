"""gmapping's particle filter: a small house is mapped while the odometry drifts."""

import itertools
import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.navigation.house import RANGE_MAX, RESOLUTION, bearings, house_cells, house_map, ranges_at

from trundle.navigation.localization._localization import OccupancyMap
from trundle.navigation.mapping import _mapping
from trundle.navigation.mapping.gmapping_settings import GmappingSettings

WORLD = house_map()
Pose = tuple[float, float, float]


def drive() -> list[Pose]:
    """Through the door and back: 0.2 m or 0.2 rad a step."""
    corners = [(1.0, 1.0), (1.0, 3.0), (5.0, 3.0), (5.0, 1.0), (4.4, 3.0), (2.0, 3.0), (1.0, 1.0)]
    poses: list[Pose] = []
    x, y, yaw = *corners[0], 0.0
    for goal_x, goal_y in corners[1:]:
        turn = math.remainder(math.atan2(goal_y - y, goal_x - x) - yaw, math.tau)
        steps = max(1, math.ceil(abs(turn) / 0.2))
        poses += [(x, y, yaw + turn * step / steps) for step in range(1, steps + 1)]
        yaw += turn
        length = math.hypot(goal_x - x, goal_y - y)
        steps = math.ceil(length / 0.2)
        poses += [
            (x + (goal_x - x) * step / steps, y + (goal_y - y) * step / steps, yaw) for step in range(1, steps + 1)
        ]
        x, y = goal_x, goal_y
    return poses


def drifted(poses: list[Pose]) -> list[Pose]:
    """Odometry of wheels that measure 3 % too long and turn 3 % too little."""
    odometry = [poses[0]]
    for last, pose in itertools.pairwise(poses):
        length = math.hypot(pose[0] - last[0], pose[1] - last[1]) * 1.03
        yaw = odometry[-1][2] + math.remainder(pose[2] - last[2], math.tau) * 0.97
        odometry.append((odometry[-1][0] + length * math.cos(yaw), odometry[-1][1] + length * math.sin(yaw), yaw))
    return odometry


def settings(**more: Any) -> GmappingSettings:
    return GmappingSettings(**{"xmin": 0.0, "ymin": 0.0, "xmax": 6.0, "ymax": 4.0, "linearUpdate": 0.2, **more})


def noisy(pose: Pose, random: np.random.Generator) -> NDArray[np.float64]:
    return ranges_at(WORLD, pose) + random.normal(0.0, 0.01, len(bearings()))


def draw(slam: _mapping.GridSlam, used: GmappingSettings) -> NDArray[np.int8]:
    height, width = house_cells().shape
    return slam.draw(first_column=0, first_row=0, width=width, height=height, occupied_threshold=used.occ_thresh)


def run_slam(used: GmappingSettings, poses: list[Pose], odometry: list[Pose]) -> _mapping.GridSlam:
    random = np.random.default_rng(1)
    slam = _mapping.GridSlam(used.slam_options(range_max_m=RANGE_MAX), bearings(), poses[0], seed=1)
    for number, (pose, measured) in enumerate(zip(poses, odometry, strict=True)):
        slam.process(measured, 0.1 * number, noisy(pose, random))
    return slam


def test_a_house_is_mapped_and_the_drift_of_the_odometry_is_removed() -> None:
    poses = drive()
    odometry = drifted(poses)
    used = settings(particles=10)
    slam = run_slam(used, poses, odometry)

    assert math.hypot(odometry[-1][0] - poses[-1][0], odometry[-1][1] - poses[-1][1]) > 0.2
    assert slam.pose[:2] == pytest.approx(poses[-1][:2], abs=0.012)
    assert math.remainder(slam.pose[2] - poses[-1][2], math.tau) == pytest.approx(0.0, abs=math.radians(0.3))
    cells, true = draw(slam, used), house_cells()
    near = np.pad(true == 100, 1)
    near = near[:-2, 1:-1] | near[2:, 1:-1] | near[1:-1, :-2] | near[1:-1, 2:] | (true == 100)
    assert near[cells == 100].mean() > 0.98
    assert (true == 0)[cells == 0].mean() > 0.97
    assert (cells == 100)[0, 5:-5].mean() > 0.8  # the wall's cells themselves
    assert slam.entropy <= math.log(10) + 1e-9


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_along_a_hall_the_odometry_decides_and_across_it_the_walls(seed: int) -> None:
    """A hall 10 m wide, and a laser of 114° that reaches 8 m: walls leave the scan; the odometry is right."""
    cells = np.zeros((200, 400), dtype=np.int8)
    cells[[0, -1], :] = cells[:, [0, -1]] = 100
    hall = OccupancyMap(cells, resolution=RESOLUTION, x=0.0, y=0.0)
    angles = np.linspace(-1.0, 1.0, 180)
    used = settings(xmax=20.0, ymax=10.0, particles=5, linearUpdate=0.5)
    slam = _mapping.GridSlam(used.slam_options(range_max_m=8.0), angles, (3.0, 5.0, 0.0), seed=seed)
    random = np.random.default_rng(seed)
    poses = [(3.0 + 0.5 * step, 5.0, 0.0) for step in range(20)]
    for step, pose in enumerate(poses):
        ranges = np.array([hall.cast_ray(*pose[:2], angle, 9.0) for angle in angles])
        slam.process(pose, 0.1 * step, np.where(ranges > 8.0, math.inf, ranges + random.normal(0.0, 0.01, 180)))

    assert slam.pose[0] == pytest.approx(poses[-1][0], abs=0.35)
    assert slam.pose[1:] == pytest.approx(poses[-1][1:], abs=0.05)


def test_scans_are_used_after_enough_motion_turn_or_time() -> None:
    used = settings(linearUpdate=1.0, angularUpdate=0.5, temporalUpdate=10.0, particles=2)
    slam = _mapping.GridSlam(used.slam_options(range_max_m=RANGE_MAX), bearings(), (1.0, 1.0, 0.0), seed=1)
    ranges = ranges_at(WORLD, (1.0, 1.0, 0.0))

    assert slam.process((0.0, 0.0, 0.0), 0.0, ranges)
    assert not slam.process((0.5, 0.0, 0.0), 1.0, ranges)
    assert slam.process((1.01, 0.0, 0.0), 2.0, ranges)
    assert not slam.process((1.01, 0.0, 0.4), 3.0, ranges)
    assert slam.process((1.01, 0.0, 0.51), 4.0, ranges)
    assert not slam.process((1.01, 0.0, 0.51), 14.0, ranges)
    assert slam.process((1.01, 0.0, 0.51), 14.1, ranges)


def test_a_match_below_the_minimum_score_keeps_the_odometry() -> None:
    poses = drive()[:20]
    matched = run_slam(settings(particles=3), poses, drifted(poses))
    unmatched = run_slam(settings(particles=3, minimumScore=1000.0), poses, drifted(poses))

    assert matched.unmatched_share == 0.0
    assert unmatched.unmatched_share == 1.0


def test_cells_of_rays_without_a_hit_are_free_up_to_the_usable_range() -> None:
    used = settings(maxUrange=1.0, particles=1)
    slam = _mapping.GridSlam(used.slam_options(range_max_m=RANGE_MAX), bearings(), (3.0, 2.0, 0.0), seed=1)
    slam.process((0.0, 0.0, 0.0), 0.0, np.full(len(bearings()), 5.0))

    cells = draw(slam, used)
    assert not (cells == 100).any()
    rows, columns = np.nonzero(cells == 0)
    distances = np.hypot((columns + 0.5) * RESOLUTION - 3.0, (rows + 0.5) * RESOLUTION - 2.0)
    assert distances.max() == pytest.approx(1.0, abs=RESOLUTION)
    assert (cells == 0).sum() == pytest.approx(math.pi / RESOLUTION**2, rel=0.08)  # cells on the edge count whole


def test_a_map_drawn_step_by_step_is_that_of_the_whole_trajectory() -> None:
    poses = drive()[:25]
    used = settings(particles=5)
    random = np.random.default_rng(1)
    slam = _mapping.GridSlam(used.slam_options(range_max_m=RANGE_MAX), bearings(), poses[0], seed=1)
    for number, (pose, measured) in enumerate(zip(poses, drifted(poses), strict=True)):
        slam.process(measured, 0.1 * number, noisy(pose, random))
        draw(slam, used)

    assert draw(slam, used).tobytes() == draw(run_slam(used, poses, drifted(poses)), used).tobytes()


def test_hostile_scans_change_nothing_but_the_map() -> None:
    used = settings(particles=2)
    options = used.slam_options(range_max_m=1e300)
    slam = _mapping.GridSlam(options, np.array([0.0, math.nan, 1e300]), (0.0, 0.0, 0.0), seed=1)
    for step in range(3):
        slam.process((float(step), 1e6 * step, 0.0), math.nan, np.array([1e300, math.nan, -math.inf]))
        slam.process((float(step), 0.0, 0.0), math.inf, np.zeros(0))
    assert draw(slam, used).shape == (80, 120)
    with pytest.raises(ValueError, match="finite"):
        slam.process((math.nan, 0.0, 0.0), 0.0, np.zeros(3))
    with pytest.raises(ValueError, match="400 million"):
        slam.draw(first_column=0, first_row=0, width=10**9, height=10**9, occupied_threshold=0.25)
