"""Random numbers of a picture."""

import math
from dataclasses import dataclass

import numpy as np

from trundle.studies.plan_files.variation import Distribution, quantile


@dataclass(frozen=True, slots=True, kw_only=True)
class Quantity:
    """Constant or random number."""

    choices: tuple[float, ...] = ()
    """Numbers to choose from; a single one is a constant."""
    distribution: Distribution | None = None
    low: float = -math.inf
    high: float = math.inf
    """Bounds, to which a normal distribution is clamped."""

    def draw(self, random: np.random.Generator) -> float:
        """Draw a number; the stream always advances by one."""
        q = float(random.random())
        if self.distribution is not None:
            return min(max(quantile(self.distribution, q), self.low), self.high)
        return self.choices[min(int(q * len(self.choices)), len(self.choices) - 1)]

    def draw_whole(self, random: np.random.Generator) -> int:
        """Draw an integer; a uniform distribution includes both ends."""
        if self.distribution is None or self.distribution.kind != "uniform":
            return round(self.draw(random))
        low, high = (round(end) for end in self.distribution.parameters)
        return min(low + int(float(random.random()) * (high - low + 1)), high)

    @property
    def largest(self) -> float:
        """Largest possible number; infinite for a normal distribution."""
        if self.distribution is None:
            return max(self.choices)
        return self.distribution.parameters[1] if self.distribution.kind != "normal" else math.inf


def constant(number: float) -> Quantity:
    """Return a constant quantity."""
    return Quantity(choices=(number,))
