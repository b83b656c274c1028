"""Rows of a sweep: values and seed of each row, determined by the plan and the row's number alone.

The rows enumerate the points of the grid, the samples of the distributions at each point, and the repetitions of each
sample, which differ in their seed only.
"""

import math
from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from trundle.base.diagnostics import DescriptionError, UsageError
from trundle.base.extras import import_extra
from trundle.studies.plan_files.variation import Value, Variation, quantile

from .plan import Plan

if TYPE_CHECKING:
    from numpy.typing import NDArray

_MAX_ROWS = 100_000_000


class Row(Struct, frozen=True):
    """One run."""

    number: int
    values: Mapping[str, Value]
    """Variation → value."""
    seed: int
    """Seed of the simulation."""


class Rows:
    """Rows of one plan."""

    def __init__(self, plan: Plan) -> None:
        """Count the rows.

        Raises:
            DescriptionError: too many rows.
        """
        self._plan = plan
        self._axes = [variation for variation in plan.vary if variation.values and variation.paired_with is None]
        self._random = [variation for variation in plan.vary if variation.distribution is not None]
        points = math.prod(len(axis.values) for axis in self._axes)
        self._count = points * plan.samples * plan.repetitions
        if self._count > _MAX_ROWS:
            at = plan.vary[0].at
            raise DescriptionError(at, f"{self._count} runs; a sweep has at most {_MAX_ROWS}: give fewer values")

    def __len__(self) -> int:
        return self._count

    def __iter__(self) -> Iterator[Row]:
        return map(self.row, range(self._count))

    def row(self, number: int) -> Row:
        """Return a row.

        Raises:
            UsageError: no such row.
        """
        if not 0 <= number < self._count:
            raise UsageError(f"there is no row {number}; the plan has rows 0 to {self._count - 1}")
        case, repetition = divmod(number, self._plan.repetitions)
        point, sample = divmod(case, self._plan.samples)
        values: dict[str, Value] = {}
        chosen: dict[str, int] = {}
        for axis in reversed(self._axes):
            point, chosen[axis.name] = divmod(point, len(axis.values))
        quantiles = iter(self._quantiles(case, sample))
        for variation in self._plan.vary:
            if variation.distribution is not None:
                values[variation.name] = quantile(variation.distribution, next(quantiles))
            else:
                values[variation.name] = variation.values[chosen[variation.paired_with or variation.name]]
        seeds = self._plan.seeds
        drawn = np.random.SeedSequence((self._plan.seed, number)).generate_state(1)[0]
        return Row(number, values, seeds[repetition] if seeds else int(drawn))

    def _quantiles(self, case: int, sample: int) -> list[float]:
        if not self._random:
            return []
        if self._plan.design == "random":
            return np.random.default_rng((self._plan.seed, case)).random(len(self._random)).tolist()
        return self._table[sample].tolist()

    @cached_property
    def _table(self) -> "NDArray[np.float64]":
        """(samples, distributions) quantiles of a space-filling design."""
        qmc = import_extra("scipy.stats.qmc")
        plan, width = self._plan, len(self._random)
        if plan.design == "latin_hypercube":
            return qmc.LatinHypercube(width, rng=plan.seed).random(plan.samples)
        # Only 2ⁿ points of a Sobol' sequence are balanced: take the next 2ⁿ, and the first `samples` of these.
        return qmc.Sobol(width, rng=plan.seed).random_base2(max(plan.samples - 1, 1).bit_length())[: plan.samples]


def column_type(variation: Variation) -> type:
    """Return the type of a variation's column; lists and mixed values are written as text."""
    kinds = {type(value) for value in variation.values} or {float}
    if kinds == {int, float}:
        return float
    (kind,) = kinds if len(kinds) == 1 else (str,)
    return kind if kind in (bool, int, float) else str
