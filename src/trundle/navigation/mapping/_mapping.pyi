"""gmapping's particle filter in C++."""

import numpy as np
from numpy.typing import NDArray

from ..pose_messages import PlanarPose

class SlamOptions:
    """Parameters, with gmapping's meaning."""

    sigma: float
    kernel_size: int
    linear_step: float
    """lstep [m]"""
    angular_step: float
    """astep [rad]"""
    iterations: int
    likelihood_sigma: float
    """lsigma"""
    skipped_beams: int
    """lskip"""
    delta: float
    """[m]"""
    max_range: float
    """[m]"""
    usable_range: float
    """maxUrange [m]"""
    minimum_score: float
    likelihood_gain: float
    """ogain"""
    srr: float
    srt: float
    str: float
    stt: float
    linear_update: float
    """[m]"""
    angular_update: float
    """[rad]"""
    temporal_update: float
    """[s]; negative: never"""
    resample_threshold: float
    particles: int

    def __init__(self) -> None: ...

class GridSlam:
    """Hypotheses of a trajectory, each with its map."""

    def __init__(self, options: SlamOptions, bearings: NDArray[np.float64], pose: PlanarPose, *, seed: int) -> None:
        """`bearings` of a scan's beams [rad]; `pose` of the laser in the map at the first scan."""

    def process(self, odometry: PlanarPose, time_s: float, ranges: NDArray[np.float64]) -> bool:
        """Move the particles; True if the scan was used: after enough motion or time since the last used one.

        Args:
            odometry: pose of the laser in the odometry's frame.
            time_s: stamp of the scan.
            ranges: (n,) [m], of the beams.
        """

    def seen(self) -> tuple[int, int, int, int]:
        """Return first column and row, last column and row of the cells that the best particle's scans crossed."""

    def draw(
        self, *, first_column: int, first_row: int, width: int, height: int, occupied_threshold: float
    ) -> NDArray[np.int8]:
        """Return the best particle's map: (height, width), row 0 at the bottom: −1 unknown, 0 free, 100 occupied.

        Cell (0, 0) has its lower left corner in the origin; first_column and first_row may be negative.
        """

    @property
    def pose(self) -> PlanarPose:
        """Pose of the laser in the map, of the best particle."""
    @property
    def entropy(self) -> float:
        """Entropy of the particles' weights."""
    @property
    def unmatched_share(self) -> float:
        """Share of particles whose match of the last scan was below the minimum score."""

class HectorOptions:
    """Parameters, with hector_mapping's meaning."""

    resolution: float
    """[m]"""
    size: int
    """[cells]"""
    start_x: float
    """Place of the world's origin, as a ratio of the size."""
    start_y: float
    levels: int
    update_factor_free: float
    update_factor_occupied: float
    update_distance: float
    """[m]"""
    update_angle: float
    """[rad]"""

    def __init__(self) -> None: ...

class HectorSlam:
    """A map, as a pyramid of grids, and the robot's pose in it."""

    def __init__(self, options: HectorOptions) -> None: ...
    def reset(self) -> None:
        """Forget the map, and put the robot at the origin."""

    def update(
        self, start: PlanarPose, sensor: tuple[float, float], ends: NDArray[np.float64], *, is_known: bool = False
    ) -> bool:
        """Match a scan; after enough motion, add it to the map; True if it was added.

        Args:
            start: first guess of the pose.
            sensor: origin of the beams in the robot's frame [m].
            ends: (n, 2) ends of the beams in the robot's frame [m].
            is_known: True: `start` is the pose, and nothing is matched.
        """

    def cells(self) -> NDArray[np.int8]:
        """Return the map: (size, size), row 0 at the bottom: −1 unknown, 0 free, 100 occupied."""

    @property
    def pose(self) -> PlanarPose:
        """Pose of the robot in the map."""
    @property
    def covariance(self) -> list[float]:
        """Covariance of the last match: xx, xy, yy, xt, yt, tt; in hector's scale, not in m² and rad²."""
    @property
    def score(self) -> float:
        """Mean probability of the cells at the ends of the last scan, 0 to 1."""
