"""amcl's particle filter: its parts against mathematics, and localization in a small house."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.ndimage import distance_transform_edt
from tests.navigation.house import RANGE_MAX, RESOLUTION, bearings, house_cells, house_map, ranges_at

from trundle.navigation.localization._localization import (
    FilterOptions,
    LaserModel,
    LaserOptions,
    OccupancyMap,
    OdometryModel,
    ParticleFilter,
)

NO_SPREAD = (0.0,) * 9
BEAM, FIELD, PROB = range(3)
DIFF, OMNI, DIFF_CORRECTED, OMNI_CORRECTED = range(4)


def options(*, count: int = 500, **more: Any) -> FilterOptions:
    defaults = {"kld_err": 0.01, "kld_z": 0.99, "alpha_slow": 0.0, "alpha_fast": 0.0}
    return FilterOptions(**{"min_particles": count, "max_particles": count, **defaults, **more})


def laser(kind: int = FIELD, **more: Any) -> LaserModel:
    laser_options = LaserOptions()
    laser_options.kind = kind
    for name, value in more.items():
        setattr(laser_options, name, value)
    return LaserModel(laser_options, house_map())


def weigh(particles: ParticleFilter, model: LaserModel, ranges: Any) -> None:
    particles.weigh(model, ranges, bearings(), range_max=RANGE_MAX, x=0.0, y=0.0)


@given(st.integers(1, 12), st.integers(1, 12), st.integers(0, 2**32 - 1))
def test_distances_are_those_of_the_euclidean_transform(width: int, height: int, seed: int) -> None:
    cells = np.random.default_rng(seed).choice(
        np.array([0, 100, -1], dtype=np.int8), (height, width), p=[0.7, 0.2, 0.1]
    )
    distances = OccupancyMap(cells, resolution=0.5, x=0.0, y=0.0).distances(2.0)

    expected = np.full(cells.shape, 2.0)
    if (cells == 100).any():
        expected = np.minimum(2.0, 0.5 * np.asarray(distance_transform_edt(cells != 100)))
    assert distances == pytest.approx(expected, abs=1e-5)


def test_rays_end_at_the_face_of_the_first_cell_that_is_not_free() -> None:
    world = house_map()
    assert world.cast_ray(2.0, 1.0, 0.0, 8.0) == pytest.approx(1.5)
    assert world.cast_ray(2.0, 1.0, math.pi, 8.0) == pytest.approx(2.0 - RESOLUTION)
    assert world.cast_ray(2.0, 1.0, 0.0, 1.0) == 1.0
    assert world.cast_ray(2.0, 1.0, math.atan2(1.0, 1.5), 8.0) == pytest.approx(math.hypot(1.0, 1.5), abs=1e-9)
    assert world.cast_ray(-1.0, 1.0, 0.0, 8.0) == 8.0


@pytest.mark.parametrize("kind", [DIFF, OMNI, DIFF_CORRECTED, OMNI_CORRECTED])
def test_odometry_without_noise_moves_particles_exactly(kind: int) -> None:
    """Half a metre ahead in a turn of 30°, as seen from another frame."""
    particles = ParticleFilter(options(count=3), house_map(), seed=1)
    particles.spread((1.0, 2.0, math.pi / 2), NO_SPREAD)
    particles.move(OdometryModel(kind, (0.0, 0.0, 0.0, 0.0, 0.0)), (0.0, 0.0, 0.0), (0.5, 0.1, 0.5))

    assert particles.particles()[:, :3] == pytest.approx(np.tile([0.9, 2.5, math.pi / 2 + 0.5], (3, 1)))


@pytest.mark.parametrize(("kind", "sigma"), [(DIFF_CORRECTED, math.sqrt(0.2)), (DIFF, 0.2), (OMNI_CORRECTED, 0.447)])
def test_noise_of_the_distance_has_the_models_deviation(kind: int, sigma: float) -> None:
    """odom_alpha3 alone; the plain models take the variance for the deviation."""
    particles = ParticleFilter(options(count=20000), house_map(), seed=1)
    particles.spread((0.0, 0.0, 0.0), NO_SPREAD)
    particles.move(OdometryModel(kind, (0.0, 0.0, 0.2, 0.0, 0.0)), (0.0, 0.0, 0.0), (1.0, 0.0, 0.0))

    assert particles.particles()[:, 0].mean() == pytest.approx(1.0, abs=0.02)
    assert particles.particles()[:, 0].std() == pytest.approx(sigma, rel=0.03)
    assert particles.particles()[:, 1].std() == pytest.approx(0.0, abs=1e-12)


def test_a_slip_aside_in_a_turn_on_the_spot_is_no_large_turn() -> None:
    """0.02 m aside in a turn of 0.3 rad: by two turns of about 90° each way, the noise would be metres."""
    particles = ParticleFilter(options(count=20000), house_map(), seed=1)
    particles.spread((0.0, 0.0, 0.0), NO_SPREAD)
    particles.move(OdometryModel(DIFF, (0.2, 0.2, 0.2, 0.2, 0.2)), (0.0, 0.0, 0.0), (0.0, -0.02, 0.3))

    x, y, yaw, _ = particles.particles().T
    assert (x.mean(), y.mean(), yaw.mean()) == pytest.approx((0.0, -0.02, 0.3), abs=0.005)
    assert (x.std(), y.std(), yaw.std()) == pytest.approx((0.0, 0.027, 0.027), abs=0.01)


def test_a_spread_has_the_requested_covariance() -> None:
    covariance = np.array([[0.3, 0.1, 0.0], [0.1, 0.2, 0.0], [0.0, 0.0, 0.05]])
    particles = ParticleFilter(options(count=20000), house_map(), seed=1)
    particles.spread((3.0, 2.0, 0.0), tuple(covariance.ravel()))

    assert np.cov(particles.particles()[:, :3].T) == pytest.approx(covariance, abs=0.01)
    _, estimated = particles.estimate()
    assert np.array(estimated).reshape(3, 3) == pytest.approx(covariance, abs=0.01)


@pytest.mark.parametrize("kind", [BEAM, FIELD, PROB])
@pytest.mark.parametrize("has_skipping", [False, True])
def test_the_true_pose_weighs_most(kind: int, has_skipping: bool) -> None:
    world, true = house_map(), (1.0, 1.0, 0.3)
    particles = ParticleFilter(options(count=2000), world, seed=1)
    particles.spread(true, (0.04, 0.0, 0.0, 0.0, 0.04, 0.0, 0.0, 0.0, 0.02))
    weigh(particles, laser(kind, do_beamskip=has_skipping), ranges_at(world, true))

    rows = particles.particles()
    best = rows[rows[:, 3].argmax()]
    assert np.hypot(*(best[:2] - true[:2])) < 0.05
    assert best[2] == pytest.approx(0.3, abs=0.06)
    assert rows[:, 3].sum() == pytest.approx(1.0)


def align(model: LaserModel, prior: tuple[float, float, float], ranges: Any) -> tuple[float, float, float]:
    return model.align(prior, ranges, bearings(), range_max=RANGE_MAX, x=0.0, y=0.0)


@pytest.mark.parametrize("kind", [FIELD, PROB])
def test_a_pose_is_aligned_with_the_walls_among_people(kind: int) -> None:
    """Every third beam ends at somebody."""
    true = (1.0, 1.0, 0.3)
    ranges = ranges_at(house_map(), true) + np.random.default_rng(1).normal(0.0, 0.01, len(bearings()))
    ranges[::3] = 0.4
    around = OccupancyMap(np.pad(house_cells(), 4, constant_values=-1), resolution=RESOLUTION, x=-0.2, y=-0.2)
    laser_options = LaserOptions()
    laser_options.kind = kind

    x, y, yaw = align(LaserModel(laser_options, around), (1.06, 0.95, 0.34), ranges)

    assert (x, y) == pytest.approx(true[:2], abs=0.4 * RESOLUTION)
    assert yaw == pytest.approx(true[2], abs=math.radians(0.5))


def test_along_a_hall_a_pose_stays_where_it_was() -> None:
    cells = np.zeros((80, 600), dtype=np.int8)
    cells[[0, -1], :] = cells[:, [0, -1]] = 100
    hall = OccupancyMap(cells, resolution=RESOLUTION, x=0.0, y=0.0)
    model = LaserModel(LaserOptions(), hall)

    assert align(model, (15.07, 2.05, 0.02), ranges_at(hall, (15.0, 2.0, 0.0))) == pytest.approx(
        (15.07, 2.0, 0.0), abs=0.01
    )


def test_beams_that_few_particles_explain_are_skipped() -> None:
    """People around the robot: half of the beams end at 0.4 m."""
    world, true = house_map(), (1.0, 1.0, 0.3)
    ranges = ranges_at(world, true)
    ranges[:180] = 0.4
    found: list[float] = []
    for has_skipping in (False, True):
        particles = ParticleFilter(options(count=2000), world, seed=1)
        particles.spread(true, (0.01, 0.0, 0.0, 0.0, 0.01, 0.0, 0.0, 0.0, 0.01))
        skipping = {"do_beamskip": has_skipping, "beam_skip_distance": 0.3}
        weigh(particles, laser(PROB, **skipping), ranges)
        rows = particles.particles()
        best = rows[rows[:, 3].argmax()]
        found.append(float(np.hypot(*(best[:2] - true[:2]))))
    assert found[1] < 0.05 < found[0]


def test_fewer_particles_suffice_when_they_are_close_together() -> None:
    """As many as bins of 0.5 m and 10° need."""
    particles = ParticleFilter(options(min_particles=100, max_particles=5000), house_map(), seed=1)
    particles.spread_over_map()
    particles.resample()
    scattered = len(particles.particles())
    particles.spread((2.3, 2.3, 0.05), (1e-4, 0.0, 0.0, 0.0, 1e-4, 0.0, 0.0, 0.0, 0.01))
    particles.resample()

    assert scattered == 5000
    assert len(particles.particles()) < 500


def test_the_first_scan_keeps_the_candidates_near_the_robot() -> None:
    """With turtlebot3's parameters, of 30,000 all over the map a few dozen are near; 3,000 are kept."""
    pose = (5.0, 1.0, 0.7)
    model = laser(max_beams=180, z_hit=0.5, z_rand=0.5, z_short=0.05, z_max=0.05, max_distance=2.0)
    particles = ParticleFilter(options(min_particles=500, max_particles=3000, kld_err=0.02), house_map(), seed=1)

    def near() -> tuple[int, float]:
        drawn = particles.particles()
        turned = np.remainder(drawn[:, 2] - pose[2] + math.pi, math.tau) - math.pi
        is_near = (np.hypot(drawn[:, 0] - pose[0], drawn[:, 1] - pose[1]) < 0.3) & (np.abs(turned) < 0.3)
        return len(drawn), float(is_near.mean())

    particles.spread_over_map()
    count, share = near()
    weigh(particles, model, ranges_at(house_map(), pose))

    assert (count, near()[0]) == (30_000, 3000)
    assert 0.0 < share < 0.003
    assert near()[1] > 50.0 * share


def test_resampling_draws_in_proportion_to_the_weights() -> None:
    world = house_map()
    particles = ParticleFilter(options(count=2000), world, seed=1)
    particles.spread((1.0, 1.0, 0.0), (0.04, 0.0, 0.0, 0.0, 0.04, 0.0, 0.0, 0.0, 0.02))
    weigh(particles, laser(), ranges_at(world, (1.0, 1.0, 0.0)))
    rows = particles.particles()
    particles.resample()

    drawn = particles.particles()
    assert drawn[:, :3].mean(axis=0) == pytest.approx(rows[:, 3] @ rows[:, :3], abs=6e-3)


def test_random_particles_come_when_scans_become_unlikely() -> None:
    """Adaptive recovery after the robot was carried into the other room."""
    world = house_map()
    particles = ParticleFilter(options(count=1000, alpha_slow=0.01, alpha_fast=0.9), world, seed=1)
    particles.spread((1.0, 1.0, 0.0), (1e-4, 0.0, 0.0, 0.0, 1e-4, 0.0, 0.0, 0.0, 1e-4))
    model = laser()
    for _ in range(3):
        weigh(particles, model, ranges_at(world, (1.0, 1.0, 0.0)))
    particles.resample()
    assert particles.particles()[:, 0].max() < 1.5

    for _ in range(3):
        weigh(particles, model, ranges_at(world, (5.0, 1.0, 2.0)))
    particles.resample()
    assert (particles.particles()[:, 0] > 3.6).sum() > 50


@pytest.mark.parametrize(
    ("alpha_fast", "hidden", "most_m"),
    [(0.0, 0, 0.05), (0.1, 120, 0.018)],
    ids=["all beams", "people in a third of the beams, and random particles"],
)
def test_an_odometry_that_is_wrong_by_a_few_percent_is_not_followed(
    alpha_fast: float, hidden: int, most_m: float
) -> None:
    """Ways come out 3 % long and turns 3 % small; 20 m to and fro in a room, with turns on the spot."""
    world, model = house_map(), laser(max_beams=90)
    particles = ParticleFilter(options(alpha_fast=alpha_fast), world, seed=1)
    particles.spread((1.0, 3.0, 0.0), (1e-3, 0.0, 0.0, 0.0, 1e-3, 0.0, 0.0, 0.0, 1e-3))
    steps = ([(0.2, 0.0)] * 9 + [(0.0, 0.25)] * 6 + [(0.0, math.pi - 1.5)]) * 10
    true = odometry = (1.0, 3.0, 0.0)
    errors: list[float] = []
    for way, turn in steps:
        true = true[0] + way * math.cos(true[2]), true[1] + way * math.sin(true[2]), true[2] + turn
        x, y, yaw = odometry
        measured = x + 1.03 * way * math.cos(yaw), y + 1.03 * way * math.sin(yaw), yaw + 0.97 * turn
        particles.move(OdometryModel(DIFF, (0.1, 0.1, 0.1, 0.1, 0.1)), odometry, measured)
        odometry = measured
        ranges = ranges_at(world, true)
        if errors:
            ranges[:hidden] = 0.5
        weigh(particles, model, ranges)
        (x, y, _), _ = particles.estimate()
        errors.append(math.hypot(x - true[0], y - true[1]))
        particles.resample()

    assert math.dist(odometry[:2], true[:2]) > 0.3
    assert np.sqrt(np.mean(np.square(errors[20:]))) < most_m


@pytest.mark.parametrize("kind", [FIELD, PROB])
@pytest.mark.parametrize("known_m", [1.2, 3.0], ids=["a piece of two walls", "a half of a room"])
def test_a_robot_that_leaves_the_known_part_of_a_map_is_not_held_back(kind: int, known_m: float) -> None:
    """9 m along a hall, with an odometry that is right; scans see all walls, the map has those near the start."""
    cells = np.zeros((80, 240), dtype=np.int8)
    cells[[0, -1], :] = cells[:, [0, -1]] = 100
    hall = OccupancyMap(cells, resolution=RESOLUTION, x=0.0, y=0.0)
    known = cells.copy()
    known[:, round(known_m / RESOLUTION) :] = -1
    part = OccupancyMap(known, resolution=RESOLUTION, x=0.0, y=0.0)
    laser_options = LaserOptions()
    laser_options.kind, laser_options.max_beams = kind, 90
    model = LaserModel(laser_options, part)
    particles = ParticleFilter(options(alpha_slow=0.001, alpha_fast=0.1), part, seed=1)
    particles.spread((1.0, 2.0, 0.0), (1e-3, 0.0, 0.0, 0.0, 1e-3, 0.0, 0.0, 0.0, 1e-3))
    errors: list[float] = []
    for i in range(45):
        pose = (1.0 + 0.2 * (i + 1), 2.0, 0.0)
        particles.move(OdometryModel(DIFF, (0.1, 0.1, 0.1, 0.1, 0.1)), (0.2 * i, 0.0, 0.0), (0.2 * (i + 1), 0.0, 0.0))
        weigh(particles, model, ranges_at(hall, pose))
        mean, _ = particles.estimate()
        x, y, _ = align(model, mean, ranges_at(hall, pose))
        errors += [math.dist(mean[:2], pose[:2]), math.hypot(x - pose[0], y - pose[1])]
        particles.resample()

    assert max(errors) < 0.2


def test_a_robot_that_turns_beyond_the_known_part_of_a_hall_is_not_drawn_back() -> None:
    """15 rad on the spot, 1 m beyond the end of the walls that the map has; scans see those and more."""
    reach_m, at = 6.0, (6.0, 2.0)
    cells = np.zeros((80, 240), dtype=np.int8)
    cells[[0, -1], :] = 100
    hall = OccupancyMap(cells, resolution=RESOLUTION, x=0.0, y=0.0)
    known = cells.copy()
    known[[0, -1], 100:] = -1
    part = OccupancyMap(known, resolution=RESOLUTION, x=0.0, y=0.0)
    model = LaserModel(LaserOptions(), part)
    particles = ParticleFilter(options(), part, seed=1)
    particles.spread((*at, 0.0), (1e-3, 0.0, 0.0, 0.0, 1e-3, 0.0, 0.0, 0.0, 1e-3))
    mean, aligned = (*at, 0.0), (*at, 0.0)
    for i in range(60):
        particles.move(OdometryModel(DIFF, (0.2, 0.2, 0.2, 0.2, 0.1)), (*at, 0.25 * i), (*at, 0.25 * (i + 1)))
        ranges = np.minimum(ranges_at(hall, (*at, 0.25 * (i + 1))), reach_m)
        particles.weigh(model, ranges, bearings(), range_max=reach_m, x=0.0, y=0.0)
        mean, _ = particles.estimate()
        particles.resample()
        aligned = model.align(mean, ranges, bearings(), range_max=reach_m, x=0.0, y=0.0)

    assert mean[0] - at[0] == pytest.approx(0.0, abs=0.09)
    assert aligned[0] == pytest.approx(mean[0], abs=0.02)


def test_same_seeds_draw_the_same_particles() -> None:
    def run() -> bytes:
        particles = ParticleFilter(options(), house_map(), seed=7)
        particles.spread_over_map()
        weigh(particles, laser(), ranges_at(house_map(), (1.0, 1.0, 0.0)))
        particles.resample()
        return particles.particles().tobytes()

    assert run() == run()


def test_hostile_inputs_are_refused_or_leave_the_weights_finite() -> None:
    with pytest.raises(ValueError, match="resolution"):
        OccupancyMap(house_cells(), resolution=math.nan, x=0.0, y=0.0)
    empty = OccupancyMap(np.zeros((0, 0), dtype=np.int8), resolution=0.05, x=0.0, y=0.0)
    for world in (empty, house_map(), OccupancyMap(house_cells(), resolution=0.05, x=math.nan, y=math.inf)):
        particles = ParticleFilter(options(count=10), world, seed=1)
        particles.spread((math.nan, 1e300, -math.inf), (1e300,) * 9)
        laser_options = LaserOptions()
        for kind in (BEAM, FIELD, PROB):
            laser_options.kind = kind
            ranges = np.array([math.nan, math.inf, -math.inf, 1e300, 1.0])
            model = LaserModel(laser_options, world)
            particles.weigh(model, ranges, np.full(5, math.nan), range_max=8.0, x=math.nan, y=0.0)
            particles.estimate()
            for x, y in ((math.nan, 1e300), (1e300, 1.0), (1.0, 1.0)):
                model.align((x, y, 0.0), ranges, np.full(5, math.nan), range_max=8.0, x=0.0, y=0.0)
            particles.resample()
            assert np.isfinite(particles.particles()[:, 3]).all()
