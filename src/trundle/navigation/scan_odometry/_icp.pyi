"""Iterated closest points and lines in C++."""

import numpy as np
from numpy.typing import NDArray

from ..pose_messages import PlanarPose

class IcpOptions:
    """Parameters of a match."""

    max_iterations: int
    epsilon_xy: float
    """[m]"""
    epsilon_theta: float
    """[rad]"""
    max_correspondence: float
    """[m]"""
    max_linear: float
    """Largest correction of the guess [m]."""
    max_angular: float
    """[rad]"""
    max_ratio: float
    """Largest share of the correspondences that is used."""
    adaptive_order: float
    adaptive_multiple: float
    sigma: float
    """Noise of a range [m]."""
    uses_lines: bool

    def __init__(self) -> None: ...

class IcpMatch:
    """Result of a match."""

    @property
    def is_valid(self) -> bool:
        """False: too few points correspond, or the correction is too large."""
    @property
    def pose(self) -> PlanarPose:
        """reference_from_scan"""
    @property
    def error(self) -> float:
        """Root of the mean square distance [m]."""
    @property
    def count(self) -> int:
        """Number of correspondences used."""
    @property
    def covariance(self) -> list[float]:
        """xx, xy, yy, xt, yt, tt [m], [rad]."""

def match_scans(
    options: IcpOptions, reference: NDArray[np.float64], scan: NDArray[np.float64], guess: PlanarPose
) -> IcpMatch:
    """Match the points (n, 2) of a scan [m] with those of a reference, both in the order of their beams."""
