"""The composition root: starts, paces and stops everything; alone knows everyone."""

from .outcome import Outcome
from .run import RunOptions, run

__all__ = ["Outcome", "RunOptions", "run"]
