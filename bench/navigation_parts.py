"""Navigation's parts alone, in a room of 10 × 8 m with 5 cm cells: CPU time of one scan, update, plan or choice.

The peers of amcl and gmapping are the real nodes' figures, of another run: 9.7 ms for 3,000 particles and 180 beams,
and 0.47 s for a scan that thirty particles use. SciPy's exact distances are the peer of inflation.
"""

import math
import time
from collections.abc import Callable
from statistics import median

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt

from bench.table import Row
from trundle.navigation import _grids
from trundle.navigation.costmap import circle
from trundle.navigation.localization import _localization as localization
from trundle.navigation.mapping import _mapping
from trundle.navigation.planners.elastic_bands import _bands

_REPEATS = 20
_SIZE_M = 0.05
_HEIGHT, _WIDTH = 160, 200
_RANGE_M = 8.0
_REAL = "the real node's figure, not in this run"
_PLACE = (2.5, 4.0, 0.3)


def run() -> list[Row]:
    """Measure each part."""
    return [_amcl(), _gmapping(), *_costmap(), _navfn(), _dwa(), _teb()]


def _cpu_ms(call: Callable[[], object], repeats: int = _REPEATS) -> float:
    """Return the median CPU time of a call [ms], after one that is not counted."""
    call()
    times: list[float] = []
    for _ in range(repeats):
        begin = time.process_time()
        call()
        times.append(time.process_time() - begin)
    return 1000.0 * median(times)


def _walls() -> NDArray[np.bool_]:
    """Two rooms with a door, and two cupboards."""
    cells = np.zeros((_HEIGHT, _WIDTH), dtype=bool)
    cells[[0, -1], :] = cells[:, [0, -1]] = True
    cells[:60, 110] = cells[80:, 110] = True
    cells[30:40, 20:50] = cells[120:128, 140:170] = True
    return cells


def _room() -> localization.OccupancyMap:
    return localization.OccupancyMap(_walls().astype(np.int8) * 100, resolution=_SIZE_M, x=0.0, y=0.0)


def _scan(room: localization.OccupancyMap, place: tuple[float, float, float], angles: NDArray[np.float64]):
    return np.array([room.cast_ray(place[0], place[1], place[2] + angle, _RANGE_M) for angle in angles])


def _amcl() -> Row:
    room = _room()
    angles = np.linspace(-math.pi, math.pi, 180, endpoint=False)
    options = localization.FilterOptions(
        min_particles=3000, max_particles=3000, kld_err=0.05, kld_z=0.99, alpha_slow=0.0, alpha_fast=0.0
    )
    particles = localization.ParticleFilter(options, room, seed=1)
    particles.spread(_PLACE, (0.05, 0.0, 0.0, 0.0, 0.05, 0.0, 0.0, 0.0, 0.02))
    laser_options = localization.LaserOptions()
    laser_options.kind, laser_options.max_beams = 1, 180
    model, ranges = localization.LaserModel(laser_options, room), _scan(room, _PLACE, angles)
    odometry = localization.OdometryModel(0, (0.2, 0.2, 0.2, 0.2, 0.2))

    def update() -> None:
        particles.move(odometry, (0.0, 0.0, 0.0), (0.01, 0.0, 0.0))
        particles.weigh(model, ranges, angles, range_max=_RANGE_M, x=0.0, y=0.0)
        particles.resample()

    value = _cpu_ms(update)
    return Row("amcl: 3,000 particles, 180 beams", value, "ms", _REAL, value / 9.7)


def _gmapping() -> Row:
    room = _room()
    angles = np.linspace(-math.pi, math.pi, 360, endpoint=False)
    options = _mapping.SlamOptions()
    options.linear_update = options.angular_update = 0.01
    options.particles = 30
    slam = _mapping.GridSlam(options, angles, (0.0, 0.0, 0.0), seed=1)
    steps = iter(range(10**6))

    def process() -> None:
        step = next(steps)
        place = (_PLACE[0] + 0.02 * step, _PLACE[1], _PLACE[2])
        assert slam.process(place, float(step), _scan(room, place, angles))

    value = _cpu_ms(process)
    return Row("gmapping: 30 particles, 360 beams", value, "ms", _REAL, value / 470.0)


def _costs() -> NDArray[np.uint8]:
    return np.where(_walls(), np.uint8(254), np.uint8(0)).astype(np.uint8)


def _inflated() -> NDArray[np.uint8]:
    cells = _costs()
    costs = [254, *(max(1, int(252 * math.exp(-0.5 * math.sqrt(square)))) for square in range(1, 122))]
    _grids.inflate(cells, (0, 0, _WIDTH, _HEIGHT), costs, inflate_unknown=False)
    return cells


def _distances() -> object:
    return distance_transform_edt(~_walls())


def _costmap() -> list[Row]:
    inflation = _cpu_ms(_inflated)
    distances = _cpu_ms(_distances)
    ends = 20.0 + 150.0 * np.random.default_rng(1).random((360, 2))
    cells = _costs()
    rays = _cpu_ms(lambda: _grids.clear_rays(cells, (100.0, 80.0), ends, range=200.0))
    return [
        Row("costmap: inflation by 0.55 m", inflation, "ms", "SciPy's distances alone", inflation / distances),
        Row("costmap: 360 rays cleared", rays, "ms", "", None),
    ]


def _navfn() -> Row:
    inflated = _inflated()
    ways = np.where(inflated >= 253, np.float32(-1.0), 50.0 + 0.8 * inflated).astype(np.float32)

    def plan() -> None:
        potential = _grids.wave_front(ways, [(20, 15)])
        assert len(_grids.descend(potential, (180, 140), (20, 15)))

    return Row("navfn: a plan of 10 m", _cpu_ms(plan), "ms", "", None)


def _dwa() -> Row:
    inflated = _inflated()
    field = _grids.wave_front(np.ones(inflated.shape, dtype=np.float32), [(180, 140)])
    maps = _grids.RolloutMaps(
        costs=inflated, path=field, goal=field, front=field, origin=(0.0, 0.0), resolution=_SIZE_M
    )
    settings = _grids.RolloutSettings(sim_time=1.7, granularity=0.025, angular_granularity=0.1)
    targets = np.array([(0.02 * i, 0.0, -1.0 + 0.05 * j) for i in range(20) for j in range(40)])
    footprint = np.array(circle(0.2))

    def choose() -> None:
        _grids.score_rollouts(settings, maps, footprint, _PLACE, (0.2, 0.0, 0.0), targets)

    return Row("DWA: 800 trajectories of 1.7 s", _cpu_ms(choose), "ms", "", None)


def _teb() -> Row:
    """Optimize a new band of 3 m through the door."""
    x = np.linspace(4.0, 7.0, 26)
    path = np.stack([x, np.full(26, 3.45), np.zeros(26)], axis=1)
    obstacles = (_bands.obstacle_outline(_costs()) + 0.5) * _SIZE_M
    settings = _bands.BandSettings()
    settings.min_obstacle_dist, settings.inflation_dist = 0.15, 0.4
    body = _bands.RobotBody(np.array([[0.0, 0.0, 0.0, 0.0, 0.2]]), is_closed=False)

    def optimize() -> None:
        band = _bands.TimedBand()
        band.set_path(path, settings)
        assert math.isfinite(band.optimize(settings, body, obstacles, np.empty((0, 2)), velocity=(0.2, 0.0, 0.0)))

    return Row("TEB: a band of 3 m through a door", _cpu_ms(optimize), "ms", "", None)
