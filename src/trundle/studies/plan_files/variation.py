"""Quantities that vary, and distributions of numbers."""

import math
from dataclasses import dataclass
from statistics import NormalDist
from typing import Literal, TypeAlias

from trundle.base.diagnostics import Source

Value: TypeAlias = bool | int | float | str | tuple["Value", ...]
_LEAST = 1e-12
"""Smallest quantile, and distance of the largest from 1: a normal distribution has no others."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Distribution:
    """Distribution of a number."""

    kind: Literal["uniform", "normal", "log_uniform"]
    parameters: tuple[float, float]
    """Smallest and largest value, or mean and standard deviation."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Variation:
    """Quantity that differs from row to row."""

    name: str
    """Path of a property, or a name of its own."""
    at: Source
    values: tuple[Value, ...] = ()
    """Values of a grid; empty for a distribution."""
    beside: str | None = None
    """Variation whose values these go with, one by one; None: every combination."""
    distribution: Distribution | None = None


def quantile(distribution: Distribution, q: float) -> float:
    """Return the value below which a share `q` of a distribution lies."""
    a, b = distribution.parameters
    if distribution.kind == "uniform":
        return a + (b - a) * q
    if distribution.kind == "log_uniform":
        return math.exp(math.log(a) + (math.log(b) - math.log(a)) * q)
    return NormalDist(a, b).inv_cdf(min(max(q, _LEAST), 1 - _LEAST))
