"""Varied quantities, and distributions of numbers."""

import math
from dataclasses import dataclass
from statistics import NormalDist
from typing import Literal, TypeAlias

from trundle.base.diagnostics import Source

Value: TypeAlias = bool | int | float | str | tuple["Value", ...]
_MIN_QUANTILE = 1e-12
"""Minimum quantile, and distance of the maximum from 1: at 0 and 1 a normal distribution is infinite."""


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
    """Path of a property, or a name defined by the plan."""
    at: Source
    values: tuple[Value, ...] = ()
    """Values of a grid; empty for a distribution."""
    paired_with: str | None = None
    """Variation with which this one is paired, value by value; None: every combination."""
    distribution: Distribution | None = None


def quantile(distribution: Distribution, q: float) -> float:
    """Return the quantile `q` of a distribution."""
    a, b = distribution.parameters
    if distribution.kind == "uniform":
        return a + (b - a) * q
    if distribution.kind == "log_uniform":
        return math.exp(math.log(a) + (math.log(b) - math.log(a)) * q)
    return NormalDist(a, b).inv_cdf(min(max(q, _MIN_QUANTILE), 1 - _MIN_QUANTILE))
