"""Sensor noise parameters."""

from msgspec import Struct


class Noise(Struct, frozen=True, kw_only=True):
    """Noise added to every value: a Gaussian, and a bias drawn once, with random sign, that may wander."""

    __module__ = "trundle"

    mean: float = 0.0
    stddev: float = 0.0
    bias_mean: float = 0.0
    bias_stddev: float = 0.0
    wander_density: float = 0.0
    """Diffusion of a bias that wanders as an Ornstein-Uhlenbeck process [units/√s]; 0: constant bias."""
    wander_time_s: float = 0.0
    """Correlation time of the bias (decay to 1/e)."""
    precision: float = 0.0
    """Quantisation step; 0: none."""
