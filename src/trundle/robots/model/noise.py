"""Sensor noise parameters."""

from msgspec import Struct


class Noise(Struct, frozen=True, kw_only=True):
    """Noise added to every value: a Gaussian, and a bias drawn once, with random sign, that may wander."""

    __module__ = "trundle"

    mean: float = 0.0
    """Mean of the Gaussian [unit of the value]."""
    stddev: float = 0.0
    """Standard deviation of the Gaussian [unit of the value]."""
    bias_mean: float = 0.0
    """Mean of the bias [unit of the value]."""
    bias_stddev: float = 0.0
    """Standard deviation of the bias [unit of the value]."""
    wander_density: float = 0.0
    """Diffusion of a bias that wanders as an Ornstein-Uhlenbeck process [units/√s]; 0: constant bias."""
    wander_time_s: float = 0.0
    """Correlation time of the bias [s], of its decay to 1/e."""
    precision: float = 0.0
    """Quantisation step [unit of the value]; 0: none."""
