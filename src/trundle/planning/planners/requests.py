"""Requests for motions, and plans."""

from collections.abc import Mapping
from typing import Any, TypeAlias, cast

import numpy as np
from msgspec import Struct, field
from numpy.typing import NDArray

from trundle.planning._planning import CancelFlag
from trundle.planning.trajectories import Trajectory
from trundle.spatial import Vector3

from .constraints import Constraints

Positions: TypeAlias = NDArray[np.float64]


class WorkspaceBounds(Struct, frozen=True):
    """Box in which planar and floating joints may be, in the model frame [m]."""

    low: Vector3 = (-5.0, -5.0, -5.0)
    high: Vector3 = (5.0, 5.0, 5.0)


class PlannerSettings(Struct, frozen=True, kw_only=True):
    """Settings of a planner, as in ompl_planning.yaml."""

    range: float = 0.0
    """Greatest length of a motion that is added to a tree [rad, m]; 0: a fifth of the space's extent."""
    goal_bias: float = 0.05
    longest_valid_segment_fraction: float = 0.005
    """Greatest step between states that are checked, as a fraction of the space's extent."""
    simplify: bool = True
    max_iterations: int = 1_000_000
    max_goal_samples: int = 10


class StartStateFixes(Struct, frozen=True, kw_only=True):
    """What is done for a start that is not valid: parameters of MoveIt's FixStartState… adapters."""

    max_bounds_error: float = 0.05
    """start_state_max_bounds_error: a variable so far beyond its limits is put onto them [rad, m]."""
    jiggle_fraction: float = 0.02
    """Greatest random motion out of a collision, as a fraction of each variable's range."""
    max_sampling_attempts: int = 100


class CartesianLimits(Struct, frozen=True, kw_only=True):
    """Limits of a link on lines and arcs: pilz_cartesian_limits.yaml."""

    max_trans_vel: float = 1.0
    """[m/s]"""
    max_trans_acc: float = 2.25
    """[m/s²]"""
    max_trans_dec: float = -5.0
    """[m/s²]"""
    max_rot_vel: float = 1.57
    """[rad/s]"""


class MotionPlanRequest(Struct, frozen=True, kw_only=True, eq=False):
    """moveit_msgs/MotionPlanRequest."""

    group: str
    goals: tuple[Constraints, ...]
    """One of them is to be reached."""
    start: Positions | None = None
    """State of all variables; None: the scene's."""
    path_constraints: Constraints = Constraints()
    planner: str = ""
    """planner_id: a planner of OMPL, PTP, LIN, CIRC, STOMP or CHOMP; empty: RRTConnect."""
    settings: PlannerSettings = PlannerSettings()
    start_fixes: StartStateFixes = StartStateFixes()
    workspace: WorkspaceBounds = WorkspaceBounds()
    allowed_time: float = 5.0
    """[s] of all attempts together."""
    attempts: int = 1
    """num_planning_attempts: of so many paths the shortest is the plan."""
    velocity_scaling: float = 1.0
    """In (0, 1], of the planners that make trajectories."""
    acceleration_scaling: float = 1.0
    cartesian_limits: CartesianLimits = CartesianLimits()
    """Limits of LIN and CIRC."""
    seed: int = 0
    """Same seed, same path."""
    cancel: CancelFlag = field(default_factory=CancelFlag)
    """Ends the search from another thread."""


class PlanStatistics(Struct, frozen=True, kw_only=True):
    """Work of a planner."""

    iterations: int = 0
    states_checked: int = 0
    nodes: int = 0
    goal_states: int = 0
    attempts: int = 1


class MotionPlan(Struct, frozen=True, kw_only=True, eq=False):
    """Path of a group."""

    group: str
    planner: str
    """Planner that found it."""
    waypoints: Positions
    """(N, len(model.variables)) states, the start first."""
    trajectory: Trajectory | None = None
    """Waypoints with times, of planners that make them; its positions are `waypoints`."""
    notes: tuple[str, ...] = ()
    """Sentences about what was done differently than asked for."""
    statistics: PlanStatistics = PlanStatistics()


def ompl_settings(config: Mapping[str, Any], group: str, planner_id: str) -> tuple[str, PlannerSettings]:
    """Return the planner's name and its settings of ompl_planning.yaml.

    Args:
        config: parameters: `planner_configs`, and one mapping per group.
        group: group that is planned.
        planner_id: name of a planner config, or a planner; empty: the group's default_planner_config, or RRTConnect.
    """
    own = _mapping(config.get(group))
    configs = _mapping(config.get("planner_configs"))
    name = planner_id or str(own.get("default_planner_config") or "") or "RRTConnect"
    name = name.removeprefix(f"{group}[").removesuffix("]")
    chosen = _mapping(configs.get(name))
    planner = str(chosen.get("type") or name)

    def number(key: str, default: float, low: float, high: float) -> float:
        try:
            value = float(chosen.get(key, own.get(key, default)))
        except (TypeError, ValueError):
            return default
        return value if low <= value <= high else default

    defaults = PlannerSettings()
    return planner, PlannerSettings(
        range=number("range", 0.0, 0.0, 1e6),
        goal_bias=number("goal_bias", defaults.goal_bias, 0.0, 1.0),
        longest_valid_segment_fraction=number(
            "longest_valid_segment_fraction", defaults.longest_valid_segment_fraction, 1e-5, 1.0
        ),
    )


def _mapping(value: object) -> Mapping[str, Any]:
    return cast("Mapping[str, Any]", value) if isinstance(value, Mapping) else {}
