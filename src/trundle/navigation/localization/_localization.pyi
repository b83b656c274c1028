"""amcl's particle filter in C++."""

import numpy as np
from numpy.typing import NDArray

from ..pose_messages import PlanarPose

class OccupancyMap:
    """Known map; cells: (height, width), row 0 at the bottom: 0 free, 100 occupied, others unknown."""

    def __init__(self, cells: NDArray[np.int8], *, resolution: float, x: float, y: float) -> None:
        """`resolution` [m] of the cells; `x`, `y`: lower left corner [m]."""

    def distances(self, limit: float) -> NDArray[np.float32]:
        """Return each cell's distance to the nearest occupied one [m], at most `limit`: (height, width)."""

    def cast_ray(self, x: float, y: float, angle: float, limit: float) -> float:
        """Return the length of a ray to the first cell that is not free [m], at most `limit`."""

class LaserOptions:
    """Parameters of the laser's model, with amcl's names and defaults."""

    kind: int
    """0: beam, 1: likelihood_field, 2: likelihood_field_prob."""
    max_beams: int
    z_hit: float
    z_short: float
    z_max: float
    z_rand: float
    sigma_hit: float
    """[m]"""
    lambda_short: float
    """[1/m]"""
    max_distance: float
    """laser_likelihood_max_dist [m]."""
    do_beamskip: bool
    beam_skip_distance: float
    """[m]"""
    beam_skip_threshold: float
    beam_skip_error_threshold: float

    def __init__(self) -> None: ...

class LaserModel:
    """Likelihood of scans in a map."""

    def __init__(self, options: LaserOptions, map: OccupancyMap) -> None: ...
    def align(
        self,
        prior: tuple[float, float, float],
        ranges: NDArray[np.float64],
        bearings: NDArray[np.float64],
        *,
        range_max: float,
        x: float,
        y: float,
    ) -> tuple[float, float, float]:
        """Return the pose near a prior one that fits a scan best; where that tells nothing, the prior one."""

class OdometryModel:
    """Noise of the odometry."""

    def __init__(self, kind: int, alphas: tuple[float, float, float, float, float]) -> None:
        """`kind`: 0: diff, 1: omni, 2: diff-corrected, 3: omni-corrected."""

class FilterOptions:
    """Parameters of the particle filter, with amcl's meaning."""

    def __init__(
        self,
        *,
        min_particles: int,
        max_particles: int,
        kld_err: float,
        kld_z: float,
        alpha_slow: float,
        alpha_fast: float,
        selective_resampling: bool = False,
    ) -> None: ...

class ParticleFilter:
    """Poses of the robot in the map with their weights."""

    def __init__(self, options: FilterOptions, map: OccupancyMap, *, seed: int) -> None: ...
    def set_options(self, options: FilterOptions) -> None:
        """Replace the options."""

    def spread(self, mean: PlanarPose, covariance: tuple[float, ...]) -> None:
        """Draw all particles from a normal distribution; `covariance`: of x, y, yaw, nine numbers row by row."""

    def spread_over_map(self) -> None:
        """Draw particles over the free cells, more than max_particles; the first scan reduces their number."""

    def move(self, model: OdometryModel, start: PlanarPose, end: PlanarPose) -> None:
        """Move the particles as the odometry moved."""

    def weigh(
        self,
        model: LaserModel,
        ranges: NDArray[np.float64],
        bearings: NDArray[np.float64],
        *,
        range_max: float,
        x: float,
        y: float,
    ) -> None:
        """Weigh the particles by a scan: ranges [m], bearings [rad] and the laser's place [m] on the robot."""

    def resample(self) -> None:
        """Resample the particles by their weights."""

    def estimate(self) -> tuple[PlanarPose, tuple[float, ...]]:
        """Return the mean of the heaviest cluster, and the covariance of all particles (nine numbers)."""

    def particles(self) -> NDArray[np.float64]:
        """Return x, y, yaw and weight of each particle: (n, 4)."""
