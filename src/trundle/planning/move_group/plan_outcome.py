"""What a planning pipeline returns."""

import numpy as np
from msgspec import Struct

from trundle.planning.planners import ErrorCode

from .controllers import JointPath


class PlanOutcome(Struct, frozen=True, eq=False, kw_only=True):
    """A path, or why there is none."""

    code: ErrorCode
    start: np.ndarray
    """State vector at the start."""
    group: str = ""
    path: JointPath | None = None
    planning_time_s: float = 0.0
    sentence: str = ""
    """Why there is no path."""

    @property
    def is_success(self) -> bool:
        """True if there is a path."""
        return self.code is ErrorCode.SUCCESS
