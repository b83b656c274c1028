"""Noise as a description states it."""

from msgspec import Struct


class Noise(Struct, frozen=True, kw_only=True):
    """What is added to every value: a Gaussian, and a bias that is drawn once, of either sign, and may wander."""

    mean: float = 0.0
    stddev: float = 0.0
    bias_mean: float = 0.0
    bias_stddev: float = 0.0
    wander_density: float = 0.0
    """What drives a bias that wanders as an Ornstein-Uhlenbeck process [units/√s]; 0: it stays."""
    wander_time_s: float = 0.0
    """In which such a bias is forgotten to 1/e."""
    precision: float = 0.0
    """Values are rounded to multiples of this; 0: they are not."""
