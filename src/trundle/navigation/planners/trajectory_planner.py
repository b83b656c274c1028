"""base_local_planner/TrajectoryPlannerROS: velocities by trajectory rollout (Gerkey, Konolige 2008)."""

import math
from typing import Annotated

import msgspec
import numpy as np
from msgspec import Meta
from numpy.typing import NDArray

from trundle.navigation import _grids
from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import Node, TransformBuffer

from ..costmap import CostmapRos
from ..settings import read_settings, reconfigure
from .dwa_planner import axis_samples
from .followed_plan import distance_fields, lengths_along, point_ahead
from .follower import Follower
from .goal_stop import Velocity
from .interfaces import Pose2D
from .motion import OdometryReader, angle_between

_Share = Annotated[float, Meta(ge=0.0, le=5.0)]
_Limit = Annotated[float, Meta(ge=0.0, le=20.0)]


class TrajectorySettings(msgspec.Struct, kw_only=True):
    """Parameters, with the original's defaults."""

    acc_lim_x: _Limit = 2.5
    acc_lim_y: _Limit = 2.5
    acc_lim_theta: _Limit = 3.2
    max_vel_x: _Limit = 0.5
    min_vel_x: _Limit = 0.1
    max_vel_theta: _Limit = 1.0
    min_vel_theta: Annotated[float, Meta(ge=-20.0, le=0.0)] = -1.0
    min_in_place_vel_theta: _Limit = 0.4
    sim_time: Annotated[float, Meta(ge=0.0, le=10.0)] = 1.0
    sim_granularity: _Share = 0.025
    angular_sim_granularity: Annotated[float, Meta(ge=0.0, le=math.pi / 2.0)] = 0.025
    path_distance_bias: _Share = 0.6
    goal_distance_bias: _Share = 0.8
    occdist_scale: _Share = 0.01
    oscillation_reset_dist: _Share = 0.05
    escape_reset_dist: _Share = 0.1
    escape_reset_theta: _Share = math.pi / 2.0
    vx_samples: Annotated[int, Meta(ge=1, le=300)] = 3
    vtheta_samples: Annotated[int, Meta(ge=1, le=300)] = 20
    heading_lookahead: _Share = 0.325
    holonomic_robot: bool = True
    escape_vel: Annotated[float, Meta(ge=-2.0, le=2.0)] = -0.1
    dwa: bool = True
    heading_scoring: bool = False
    heading_scoring_timestep: Annotated[float, Meta(ge=0.0, le=1.0)] = 0.8
    simple_attractor: bool = False
    y_vels: str = "-0.3,-0.1,0.1,0.3"
    meter_scoring: bool = False
    prune_plan: bool = True
    xy_goal_tolerance: float = 0.1
    yaw_goal_tolerance: float = 0.05
    latch_xy_goal_tolerance: bool = False


_OLD_NAMES = {
    "pdist_scale": "path_distance_bias",
    "gdist_scale": "goal_distance_bias",
    "max_rotational_vel": "max_vel_theta",
    "min_in_place_rotational_vel": "min_in_place_vel_theta",
    "acc_lim_th": "acc_lim_theta",
}
_STOPPED = 0.01
_SPOT_PENALTY, _SIDEWAYS_PENALTY, _ESCAPE_PENALTY = 1e6, 1e7, 1e9
"""Added to turns on the spot, which would always cost least, then to motion sideways, as robots with two wheels are
`holonomic_robot` by default, and to motion backwards."""


class TrajectoryPlannerROS(Follower):
    """Samples reachable velocities, simulates each, and commands the one of the least cost.

    Parameters are the original's (`TrajectorySettings`); pdist_scale, gdist_scale, max_rotational_vel,
    min_in_place_rotational_vel and acc_lim_th are read, too. As in the original, a robot moves sideways only where it
    can neither drive forwards nor turn. Unlike in the original, a robot turns on the spot before it follows a path that
    begins beside or behind it.
    """

    def __init__(
        self,
        node: Node,
        name: str,
        section: RosParameters,
        root: RosParameters,
        costmap: CostmapRos,
        buffer: TransformBuffer,
        odom: OdometryReader,
    ) -> None:
        section = section.renamed(_OLD_NAMES)
        self._settings = settings = read_settings(TrajectorySettings, section)
        if "min_vel_theta" not in section:
            settings.min_vel_theta = -settings.max_vel_theta
        if "angular_sim_granularity" not in section:
            settings.angular_sim_granularity = settings.sim_granularity
        self._y_samples = _read_y_samples(settings.y_vels, section.namespace)
        super().__init__(
            node, name, (section, root), settings, costmap, buffer, odom, stopped_speed=_STOPPED, stopped_turn=_STOPPED
        )
        reconfigure(node, f"{node.name}/{name}", settings, lambda: None)

    @property
    def turn_limits(self) -> tuple[float, float]:
        """See `Follower`."""
        return self._settings.min_in_place_vel_theta, self._settings.max_vel_theta

    @property
    def speed_limits(self) -> tuple[float, float]:
        """See `LocalPlanner`."""
        return self._settings.max_vel_x, self._settings.max_vel_theta

    @speed_limits.setter
    def speed_limits(self, limits: tuple[float, float]) -> None:
        self._settings.max_vel_x, self._settings.max_vel_theta = limits
        self._settings.min_vel_theta = -limits[1]

    @property
    def turns_first(self) -> bool:
        """See `Follower`."""
        return not self._settings.holonomic_robot

    def rollout_settings(self, time_s: float) -> _grids.RolloutSettings:
        """See `Follower`."""
        settings = self._settings
        return _grids.RolloutSettings(
            sim_time=max(time_s, 1e-3),
            granularity=max(settings.sim_granularity, 1e-3),
            angular_granularity=max(settings.angular_sim_granularity, 1e-3),
            forward_point=settings.heading_lookahead,
            acceleration=(settings.acc_lim_x, settings.acc_lim_y, settings.acc_lim_theta),
            accelerates=True,
        )

    def best(self, pose: Pose2D, plan: NDArray[np.float64]) -> Velocity | None:
        """See `Follower`."""
        samples = self.oscillation.allowed(self._samples())
        settings, grid = self._settings, self.costmap.costmap
        end = (float(plan[-1, 0]), float(plan[-1, 1]))
        path, goal, front = distance_fields(grid, plan, end)
        maps = _grids.RolloutMaps(
            costs=grid.cells, path=path, goal=goal, front=front, origin=grid.origin, resolution=grid.resolution_m
        )
        horizon_s = self.horizon_s(pose, plan, settings.max_vel_x, settings.sim_time)
        terms = _grids.score_rollouts(
            self.rollout_settings(horizon_s), maps, self.costmap.footprint, pose, self.odom.velocity, samples
        )
        path_costs = self._path_costs(plan, np.abs(samples[:, 0]) * horizon_s)
        obstacles = terms[:, 0]
        obstacles[obstacles > 0.0] = np.maximum(obstacles - path_costs, 0.0)[obstacles > 0.0]
        scores = self._scores(terms, samples, pose, plan)
        best = int(scores.argmin()) if len(scores) else -1
        if best < 0 or not math.isfinite(scores[best]):
            return None
        x, y, turn = samples[best].tolist()
        self.oscillation.note(pose, (x, y, turn), settings.oscillation_reset_dist, settings.escape_reset_theta)
        return x, y, turn

    def _path_costs(self, plan: NDArray[np.float64], lengths_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the highest cost under the footprint on the first part of the plan, for each of the lengths.

        A trajectory's cost counts only above it; otherwise standing before a door would cost less than passing it.
        """
        grid = self.costmap.costmap
        along = lengths_along(plan)
        count = int(np.searchsorted(along, float(lengths_m.max()))) + 1
        costs = [
            _grids.footprint_cost(grid.cells, grid.origin, grid.resolution_m, self.costmap.footprint, (x, y, yaw))
            for x, y, yaw in plan[:count].tolist()
        ]
        highest = np.maximum.accumulate(np.maximum(costs, 0.0))
        return highest[np.minimum(np.searchsorted(along, lengths_m), len(highest) - 1)]

    def _scores(
        self, terms: NDArray[np.float64], samples: NDArray[np.float64], pose: Pose2D, plan: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Return the costs; infinite for trajectories that collide or leave the map."""
        settings = self._settings
        scale = self.costmap.costmap.resolution_m if settings.meter_scoring else 1.0
        obstacles, path, goal, front, _, steps = terms.T
        is_valid = (obstacles >= 0.0) & (steps > 0.0) & (path < _grids.UNREACHED) & (goal < _grids.UNREACHED)
        costs: NDArray[np.float64] = settings.occdist_scale * obstacles
        if settings.simple_attractor:
            ends = np.array([self._end(pose, sample) for sample in samples]).reshape(-1, 2)
            offsets = ends - plan[-1, :2]
            costs = (offsets**2).sum(axis=1)
        elif settings.heading_scoring:
            ahead = point_ahead(plan, settings.heading_lookahead)
            direction = math.atan2(ahead.y - pose.y, ahead.x - pose.x)
            yaws = pose.yaw + samples[:, 2] * settings.heading_scoring_timestep
            misses = np.array([abs(angle_between(float(yaw), direction)) for yaw in yaws])
            costs = costs + 0.3 * scale * settings.path_distance_bias * path + misses
            costs += scale * settings.goal_distance_bias * goal
        else:
            costs = costs + scale * (settings.path_distance_bias * path + settings.goal_distance_bias * goal)
        is_spot = (samples[:, 0] == 0.0) & (samples[:, 1] == 0.0)
        costs[is_spot] = _SPOT_PENALTY + front[is_spot]
        costs[samples[:, 1] != 0.0] += _SIDEWAYS_PENALTY
        costs[samples[:, 0] < 0.0] += _ESCAPE_PENALTY
        return np.where(is_valid, costs, math.inf)

    def _end(self, pose: Pose2D, sample: NDArray[np.float64]) -> tuple[float, float]:
        """Return the end of a sample's trajectory [m]."""
        x, y, turn = sample.tolist()
        path = _grids.roll_out(self.rollout_settings(self._settings.sim_time), pose, self.odom.velocity, (x, y, turn))
        return (path[-1][0], path[-1][1]) if path else (pose.x, pose.y)

    def _samples(self) -> NDArray[np.float64]:
        """Return the velocities (n, 3): forwards with turns, turns on the spot, sideways, and back to escape."""
        settings = self._settings
        now_x, _, now_turn = self.odom.velocity
        time_s = self.period_s if settings.dwa else settings.sim_time
        high_x = min(settings.max_vel_x, now_x + settings.acc_lim_x * time_s)
        low_x = min(max(settings.min_vel_x, now_x - settings.acc_lim_x * time_s), max(high_x, settings.min_vel_x))
        high_turn = min(settings.max_vel_theta, now_turn + settings.acc_lim_theta * time_s)
        low_turn = max(settings.min_vel_theta, now_turn - settings.acc_lim_theta * time_s)
        speeds = axis_samples(low_x, max(high_x, low_x), settings.vx_samples)
        turns = np.append(axis_samples(low_turn, max(high_turn, low_turn), settings.vtheta_samples), 0.0)
        # The fastest first: many end in one cell, and cost the same.
        forward = np.array([(x, 0.0, turn) for x in speeds[::-1] for turn in turns])
        least = settings.min_in_place_vel_theta
        spots = np.where(turns > 0.0, np.maximum(turns, least), np.minimum(turns, -least))
        in_place = np.array([(0.0, 0.0, turn) for turn in spots])
        escape = np.array([(settings.escape_vel, 0.0, 0.0)])
        sideways = np.array([(0.0, y, 0.0) for y in self._y_samples if settings.holonomic_robot]).reshape(-1, 3)
        return np.ascontiguousarray(np.vstack([forward, in_place, sideways, escape]))


def _read_y_samples(text: str, namespace: str) -> list[float]:
    try:
        values = [float(value) for value in text.split(",") if value.strip()]
    except ValueError:
        raise ParamError(f"parameter {namespace}/y_vels: {text!r} is not a list of numbers") from None
    if not all(map(math.isfinite, values)):
        raise ParamError(f"parameter {namespace}/y_vels: {text!r} has a number that is not finite")
    return values
