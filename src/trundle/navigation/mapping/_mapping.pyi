"""gmapping's particle filter, hector_mapping's pyramid and the pose graph's mapper in C++."""

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

class SearchOptions:
    """Grid of poses about a start."""

    half_width: float
    """Along each axis [m]."""
    half_angle: float
    """[rad]"""
    angle_step: float
    """[rad]"""
    fine_angle_step: float
    """Of the search about the best pose [rad]."""
    is_penalized: bool
    """True: poses away from the start count less, as Karto's."""
    distance_variance: float
    """[m²]"""
    angle_variance: float
    """[rad²]"""
    least_distance_factor: float
    least_angle_factor: float

    def __init__(self) -> None: ...

class GraphOptions:
    """When scans are used, what they are matched with, and what closes a loop."""

    resolution: float
    """Of the map [m]."""
    least_distance: float
    """Between used scans [m]."""
    least_angle: float
    """[rad]"""
    least_time: float
    """[s]"""
    longest_time: float
    """After which a scan is used without motion [s]."""
    matches_scans: bool
    matches_all: bool
    """True: scans between the used ones are matched, too."""
    uses_center: bool
    """True: distances between scans are those of their centers, not of the robot."""
    running_scans: int
    """Scans before that a scan is matched with."""
    running_distance: float
    """[m]"""
    link_distance: float
    """Of scans nearby [m]."""
    link_response: float
    closes_loops: bool
    loop_distance: float
    """[m]"""
    loop_chain: int
    """Least number of consecutive scans."""
    loop_deviation: float
    """Highest of a match [m]."""
    loop_response_coarse: float
    loop_response_fine: float
    window_resolution: float
    """[m]"""
    window_smear: float
    """[m]"""
    search: SearchOptions
    loop_window_resolution: float
    """[m]"""
    loop_window_smear: float
    """[m]"""
    loop_search: SearchOptions
    linear_noise: float
    """Deviation of the odometry, as a part of the way."""
    angular_noise: float
    """As a part of the turn."""
    turn_per_distance: float
    """[rad / m]"""
    still_linear_noise: float
    """Deviation without motion [m]."""
    still_angular_noise: float
    """[rad]"""
    extends_map: bool
    """False: scans are matched with the map, and forgotten."""

    def __init__(self) -> None: ...

class GraphSlam:
    """Poses of scans as a graph of what was measured between them."""

    def __init__(self, options: GraphOptions) -> None: ...
    def process(
        self,
        motion: PlanarPose,
        time_s: float,
        origin: tuple[float, float],
        hits: NDArray[np.float64],
        misses: NDArray[np.float64],
    ) -> bool:
        """Move the robot and match a scan; True if it became a node, after enough motion or time.

        Args:
            motion: of the robot since the last call, in its frame then.
            time_s: stamp of the scan.
            origin: of the beams on the robot [m].
            hits: (n, 2) ends of beams that hit something, on the robot, in the order of the beams [m].
            misses: (m, 2) ends of what is free along beams without a hit [m].
        """

    def set_pose(self, pose: PlanarPose) -> None:
        """Put the robot somewhere in the map; the next scan is searched for as for a loop."""

    def seen(self) -> tuple[int, int, int, int]:
        """Return first column and row, last column and row of the cells that scans crossed."""

    def draw(
        self, *, first_column: int, first_row: int, width: int, height: int, occupied_threshold: float
    ) -> NDArray[np.int8]:
        """Return the map: (height, width), row 0 at the bottom: −1 unknown, 0 free, 100 occupied.

        Cell (0, 0) has its lower left corner in the origin; first_column and first_row may be negative.
        """

    def poses(self) -> NDArray[np.float64]:
        """Return x, y [m] and yaw [rad] of the robot at each node (n, 3)."""

    def constraints(self) -> NDArray[np.float64]:
        """Return from, to, x, y, yaw and information xx, xy, yy, xt, yt, tt in the frame of `from` (m, 11)."""

    def scans(
        self,
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.int64], NDArray[np.float64], NDArray[np.int64]]:
        """Return origins (n, 2), all hits (h, 2), their number in each scan (n,), all misses, their numbers."""

    def restore(
        self,
        poses: NDArray[np.float64],
        constraints: NDArray[np.float64],
        origins: NDArray[np.float64],
        hits: NDArray[np.float64],
        hit_counts: NDArray[np.int64],
        misses: NDArray[np.float64],
        miss_counts: NDArray[np.int64],
    ) -> None:
        """Go on from a graph, as the functions above return it.

        Raises:
            ValueError: numbers are not finite, or do not fit each other.
        """

    @property
    def pose(self) -> PlanarPose:
        """Pose of the robot in the map at the last scan."""
    @property
    def correction(self) -> PlanarPose:
        """What optimizations moved the robot by: map_from_local, where the scans alone would have left it."""
    @property
    def covariance(self) -> list[float]:
        """Of the last match with the odometry: xx, xy, yy, xt, yt, tt [m], [rad]."""
    @property
    def response(self) -> float:
        """Mean value of the window at the last scan's hits, 0 to 1."""
    @property
    def loops(self) -> int:
        """Number of loops closed."""
    @property
    def refused_loops(self) -> int:
        """Number of loops that would have bent the graph more than its uncertainty allows."""
