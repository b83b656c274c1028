"""Parameters of mbf_costmap_nav."""

from typing import Annotated

import msgspec
from msgspec import Meta

_Time = Annotated[float, Meta(ge=0.0, le=100.0)]
_Retries = Annotated[int, Meta(ge=-1, le=1000)]


class MbfSettings(msgspec.Struct, kw_only=True):
    """Parameters, with the original's defaults; times [s], lengths [m]."""

    planner_frequency: _Time = 0.0
    planner_patience: _Time = 5.0
    planner_max_retries: _Retries = -1
    controller_frequency: _Time = 20.0
    controller_patience: _Time = 5.0
    controller_max_retries: _Retries = -1
    recovery_enabled: bool = True
    recovery_patience: _Time = 15.0
    oscillation_timeout: Annotated[float, Meta(ge=0.0, le=60.0)] = 0.0
    oscillation_distance: Annotated[float, Meta(ge=0.0, le=10.0)] = 0.5

    def of_run(self) -> "RunParameters":
        """Return the parameters of a run to one goal by move_base's names."""
        return RunParameters(
            planner_frequency=self.planner_frequency,
            controller_frequency=self.controller_frequency,
            planner_patience=self.planner_patience,
            controller_patience=self.controller_patience,
            max_planning_retries=self.planner_max_retries,
            recovery_behavior_enabled=self.recovery_enabled,
            oscillation_timeout=self.oscillation_timeout,
            oscillation_distance=self.oscillation_distance,
        )


class RunParameters(msgspec.Struct, kw_only=True):
    """See `move_base.goal_run.RunSettings`."""

    planner_frequency: float
    controller_frequency: float
    planner_patience: float
    controller_patience: float
    max_planning_retries: int
    recovery_behavior_enabled: bool
    oscillation_timeout: float
    oscillation_distance: float
