"""dwa_local_planner/DWAPlannerROS: velocities by the dynamic window approach (Fox, Burgard, Thrun 1997)."""

import math
from typing import Annotated

import msgspec
import numpy as np
from msgspec import Meta
from numpy.typing import NDArray

from trundle.navigation import _grids
from trundle.robots.parameters import RosParameters
from trundle.ros import Node, TransformBuffer

from ..costmap import CostmapRos
from ..settings import read_settings, reconfigure
from .followed_plan import distance_fields
from .follower import Follower
from .goal_stop import Velocity
from .interfaces import Pose2D
from .motion import OdometryReader, approach

_Positive = Annotated[float, Meta(ge=0.0)]
_EPSILON = 1e-4


class DwaSettings(msgspec.Struct, kw_only=True):
    """Parameters, with the original's defaults."""

    max_vel_trans: _Positive = 0.55
    min_vel_trans: _Positive = 0.1
    max_vel_x: float = 0.55
    min_vel_x: float = 0.0
    max_vel_y: float = 0.1
    min_vel_y: float = -0.1
    max_vel_theta: _Positive = 1.0
    min_vel_theta: _Positive = 0.4
    acc_lim_x: Annotated[float, Meta(ge=0.0, le=20.0)] = 2.5
    acc_lim_y: Annotated[float, Meta(ge=0.0, le=20.0)] = 2.5
    acc_lim_theta: Annotated[float, Meta(ge=0.0, le=20.0)] = 3.2
    acc_lim_trans: _Positive = 0.1
    prune_plan: bool = False
    xy_goal_tolerance: float = 0.1
    yaw_goal_tolerance: float = 0.1
    trans_stopped_vel: float = 0.1
    theta_stopped_vel: float = 0.1
    sim_time: _Positive = 1.7
    sim_granularity: _Positive = 0.025
    angular_sim_granularity: _Positive = 0.1
    path_distance_bias: _Positive = 0.6
    goal_distance_bias: _Positive = 0.8
    occdist_scale: _Positive = 0.01
    twirling_scale: _Positive = 0.0
    stop_time_buffer: _Positive = 0.2
    oscillation_reset_dist: _Positive = 0.05
    oscillation_reset_angle: _Positive = 0.2
    forward_point_distance: float = 0.325
    scaling_speed: _Positive = 0.25
    max_scaling_factor: _Positive = 0.2
    vx_samples: Annotated[int, Meta(ge=0)] = 3
    vy_samples: Annotated[int, Meta(ge=0)] = 10
    vth_samples: Annotated[int, Meta(ge=0)] = 20
    use_dwa: bool = True
    latch_xy_goal_tolerance: bool = False


_OLD_NAMES = {
    "max_trans_vel": "max_vel_trans",
    "min_trans_vel": "min_vel_trans",
    "max_rot_vel": "max_vel_theta",
    "min_rot_vel": "min_vel_theta",
    "acc_limit_trans": "acc_lim_trans",
    "acc_lim_th": "acc_lim_theta",
    "rot_stopped_vel": "theta_stopped_vel",
}
"""Name before Melodic → name since."""


class DWAPlannerROS(Follower):
    """Samples reachable velocities, simulates each, and commands the one of the best score.

    Parameters are the original's (`DwaSettings`), their names before Melodic, `controller_frequency`,
    `sum_scores` and `cheat_factor`, and `min_turning_radius` [m] for a car, whose direction at the goal is free. With
    one of the old names occdist_scale has its weight of that time, 2 · resolution of today's. Unlike in the original,
    trajectories accelerate toward any velocity, and a robot turns on the spot before it follows a path that begins
    beside or behind it.
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
        self._is_old = any(old in section and new not in section for old, new in _OLD_NAMES.items())
        section = section.renamed(_OLD_NAMES)
        self._settings = settings = read_settings(DwaSettings, section)
        self._turning_radius_m = section.number("min_turning_radius", 0.0, minimum=0.0)
        if self._turning_radius_m > 0.0:
            settings.yaw_goal_tolerance = math.pi  # a car does not turn on the spot
        self._sums_scores = section.flag("sum_scores", default=False)
        self._cheat_factor = section.number("cheat_factor", 1.0)
        super().__init__(
            node,
            name,
            (section, root),
            settings,
            costmap,
            buffer,
            odom,
            stopped_speed=settings.trans_stopped_vel,
            stopped_turn=settings.theta_stopped_vel,
        )
        reconfigure(node, f"{node.name}/{name}", settings, lambda: None)

    @property
    def turn_limits(self) -> tuple[float, float]:
        """See `Follower`."""
        return self._settings.min_vel_theta, self._settings.max_vel_theta

    @property
    def speed_limits(self) -> tuple[float, float]:
        """See `LocalPlanner`."""
        return self._settings.max_vel_trans, self._settings.max_vel_theta

    @speed_limits.setter
    def speed_limits(self, limits: tuple[float, float]) -> None:
        self._settings.max_vel_trans, self._settings.max_vel_theta = limits

    @property
    def turns_first(self) -> bool:
        """See `Follower`."""
        return self._settings.max_vel_y <= 0.0 and self._turning_radius_m <= 0.0

    def best(self, pose: Pose2D, plan: NDArray[np.float64]) -> Velocity | None:
        """See `Follower`."""
        samples = self.oscillation.allowed(self._samples())
        if not len(samples):
            return None
        settings, grid = self._settings, self.costmap.costmap
        end = Pose2D(*plan[-1].tolist())
        forward = settings.forward_point_distance
        direction = math.atan2(end.y - pose.y, end.x - pose.x)
        front = (end.x + forward * math.cos(direction), end.y + forward * math.sin(direction))
        path, goal, beyond = distance_fields(grid, plan, front)
        maps = _grids.RolloutMaps(
            costs=grid.cells, path=path, goal=goal, front=beyond, origin=grid.origin, resolution=grid.resolution_m
        )
        horizon_s = self.horizon_s(pose, plan, settings.max_vel_trans, settings.sim_time)
        terms = _grids.score_rollouts(
            self.rollout_settings(horizon_s), maps, self.costmap.footprint, pose, self.odom.velocity, samples
        )
        is_near = math.hypot(end.x - pose.x, end.y - pose.y) <= abs(forward) * self._cheat_factor
        scores = self._scores(terms, samples, is_near_end=is_near)
        best = int(scores.argmin())
        if not math.isfinite(scores[best]):
            self.node.log.warn("DWA planner failed to produce path.")
            return None
        x, y, turn = samples[best].tolist()
        self.oscillation.note(pose, (x, y, turn), settings.oscillation_reset_dist, settings.oscillation_reset_angle)
        return self._toward((x, y, turn))

    def rollout_settings(self, time_s: float) -> _grids.RolloutSettings:
        """See `Follower`."""
        settings = self._settings
        return _grids.RolloutSettings(
            sim_time=max(time_s, 1e-3),
            granularity=max(settings.sim_granularity, 1e-3),
            angular_granularity=max(settings.angular_sim_granularity, 1e-3),
            forward_point=settings.forward_point_distance,
            acceleration=(settings.acc_lim_x, settings.acc_lim_y, settings.acc_lim_theta),
            accelerates=True,
            sums_costs=self._sums_scores,
        )

    def _scores(
        self, terms: NDArray[np.float64], samples: NDArray[np.float64], *, is_near_end: bool
    ) -> NDArray[np.float64]:
        """Return the weighted sums; infinite for trajectories that collide or leave the map."""
        settings = self._settings
        resolution = self.costmap.costmap.resolution_m
        path_scale, goal_scale = resolution * settings.path_distance_bias, resolution * settings.goal_distance_bias
        # Before Melodic, which renamed parameters, too, it was resolution · occdist_scale and half of the others.
        obstacle_scale = settings.occdist_scale * (2.0 * resolution if self._is_old else 1.0)
        obstacles, path, goal, front, alignment, steps = terms.T
        is_valid = (obstacles >= 0.0) & (steps > 0.0)
        for distance in (path, goal):
            is_valid &= distance < _grids.UNREACHED
        scores = obstacle_scale * obstacles + path_scale * path + goal_scale * goal
        ahead = front < _grids.UNREACHED
        scores += goal_scale * np.where(ahead, front, 2.0 * len(self.costmap.costmap.cells))
        if not is_near_end:
            beside = np.where(alignment < _grids.UNREACHED, alignment, 2.0 * len(self.costmap.costmap.cells))
            scores += path_scale * beside
        scores += settings.twirling_scale * np.abs(samples[:, 2])
        return np.where(is_valid, scores, math.inf)

    def _samples(self) -> NDArray[np.float64]:
        """Return velocities (n, 3) to approach: a dense grid of the reachable ones, and a coarse one of all.

        Reachable means within one control period, or without `use_dwa` within the simulated time.

        The original samples only reachable velocities and holds each for the whole time, so that no trajectory of a
        robot that turns fast slows down.
        """
        settings = self._settings
        low = np.array([settings.min_vel_x, settings.min_vel_y, -settings.max_vel_theta])
        high = np.array([settings.max_vel_x, settings.max_vel_y, settings.max_vel_theta])
        now = np.array(self.odom.velocity)
        step = self._accelerations * (self.period_s if settings.use_dwa else settings.sim_time)
        counts = (settings.vx_samples, settings.vy_samples, settings.vth_samples)
        near_low, near_high = np.maximum(low, now - step), np.minimum(high, now + step)
        axes: list[NDArray[np.float64]] = []
        for axis, count in enumerate(counts):
            near = axis_samples(float(near_low[axis]), float(near_high[axis]), (count + 1) // 2)
            far = axis_samples(float(low[axis]), float(high[axis]), count // 2)
            axes.append(np.unique(np.append(near, far)))
        samples = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
        speed, turn = np.hypot(samples[:, 0], samples[:, 1]), np.abs(samples[:, 2])
        is_slow = (speed + _EPSILON < settings.min_vel_trans) & (turn + _EPSILON < settings.min_vel_theta)
        is_too_tight = turn * self._turning_radius_m > speed + _EPSILON
        return np.ascontiguousarray(samples[~is_slow & ~is_too_tight & (speed - _EPSILON <= settings.max_vel_trans)])

    @property
    def _accelerations(self) -> NDArray[np.float64]:
        settings = self._settings
        return np.array([settings.acc_lim_x, settings.acc_lim_y, settings.acc_lim_theta])

    def _toward(self, target: Velocity) -> Velocity:
        """Return the velocity one period later, toward a target; a turn on the spot has at least min_vel_theta."""
        step = (self._accelerations * self.period_s).tolist()
        x, y, turn = (approach(*args) for args in zip(self.odom.velocity, target, step, strict=True))
        least = self._settings.min_vel_theta
        if self._turning_radius_m > 0.0:
            tightest = abs(x) / self._turning_radius_m
            return x, y, min(max(turn, -tightest), tightest)
        if math.hypot(x, y) < self._settings.min_vel_trans and math.hypot(target[0], target[1]) < _EPSILON:
            turn = math.copysign(max(abs(turn), least), target[2])
        return x, y, turn


def axis_samples(low: float, high: float, count: int) -> NDArray[np.float64]:
    """Return values from low to high, and 0 if it lies between."""
    if high <= low:
        return np.array([high])
    values = np.linspace(low, high, max(count, 2))
    return np.unique(np.append(values, 0.0)) if low < 0.0 < high else values
