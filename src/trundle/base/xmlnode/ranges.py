"""Ranges of numbers in files.

Numbers beyond them mean a damaged file or an attack: their square or cube overflows later, where the line is unknown.
"""

from collections.abc import Iterable

MAX_LENGTH = 1e9
"""Limit of coordinates, sizes and scales [m]: a million kilometres."""
MAX_MASS = 1e12
"""Limit of masses [kg]."""
MAX_NUMBER = 1e18
"""Limit of gains, rates and all other numbers: 1e16 is SDF's unlimited, 1e12 ODE's stiffness of contacts."""


def is_within(values: Iterable[float], limit: float) -> bool:
    """True if all numbers are finite and no further from 0 than `limit`."""
    return all(-limit <= value <= limit for value in values)
