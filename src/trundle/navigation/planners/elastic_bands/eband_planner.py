"""eband_local_planner/EBandPlannerROS: velocities along an elastic band of bubbles (Quinlan, Khatib 1993)."""

import math
from typing import Annotated

import msgspec
import numpy as np
from msgspec import Meta
from numpy.typing import NDArray

from trundle.navigation import _grids
from trundle.robots.parameters import RosParameters
from trundle.ros import Node, TransformBuffer

from ...costmap import CostmapRos
from ...settings import read_settings, reconfigure
from ..followed_plan import lengths_along
from ..follower import Follower
from ..goal_stop import Velocity
from ..interfaces import Pose2D
from ..motion import OdometryReader, angle_between, approach
from ._bands import BubbleSettings, obstacle_outline, relax_bubbles
from .unused_parameters import report_unused

_Positive = Annotated[float, Meta(ge=0.0, le=1000.0)]
_Count = Annotated[int, Meta(ge=1, le=100)]
_LOOKAHEAD_M = 0.3
"""Least distance of the point along the band that the robot drives at."""
_SPHERE = 2


class EBandSettings(msgspec.Struct, kw_only=True):
    """Parameters that act here, with the original's defaults; lengths [m], angles [rad]."""

    xy_goal_tolerance: _Positive = 0.1
    yaw_goal_tolerance: _Positive = 0.05
    rot_stopped_vel: _Positive = 0.01
    trans_stopped_vel: _Positive = 0.01
    marker_lifetime: _Positive = 0.5
    eband_min_relative_overlap: _Positive = 0.7
    eband_tiny_bubble_expansion: _Positive = 0.01
    eband_internal_force_gain: _Positive = 1.0
    eband_external_force_gain: _Positive = 2.0
    num_iterations_eband_optimization: _Count = 3
    eband_equilibrium_approx_max_recursion_depth: _Count = 4
    eband_significant_force_lower_bound: _Positive = 0.15
    max_vel_lin: _Positive = 0.75
    max_vel_th: _Positive = 1.0
    min_vel_lin: _Positive = 0.1
    min_vel_th: _Positive = 0.0
    min_in_place_vel_th: _Positive = 0.0
    max_acceleration: _Positive = 0.5
    max_translational_acceleration: _Positive = 0.5
    max_rotational_acceleration: _Positive = 1.5
    rotation_correction_threshold: _Positive = 0.5
    differential_drive: bool = True
    bubble_velocity_multiplier: _Positive = 2.0
    rotation_threshold_multiplier: _Positive = 1.0
    latch_xy_goal_tolerance: bool = False


_OLD_NAMES = {"max_vel_theta": "max_vel_th"}
_USED = frozenset({*EBandSettings.__struct_fields__, *_OLD_NAMES, "controller_frequency", "odom_topic"})
_WITHOUT_EFFECT = frozenset(
    {
        "Ctrl_Rate",
        "costmap_weight",
        "disallow_hysteresis",
        "eband_equilibrium_relative_overshoot",
        "eband_tiny_bubble_distance",
        "in_place_trans_vel",
        "k_damp",
        "k_prop",
        "virtual_mass",
    }
)
"""Parameters of the original that are read by nothing: the robot drives arcs, and follows no virtual mass."""


class _Limits:
    """The settings as limits of the stop at the goal."""

    def __init__(self, settings: EBandSettings) -> None:
        self.xy_goal_tolerance = settings.xy_goal_tolerance
        self.yaw_goal_tolerance = settings.yaw_goal_tolerance
        self.latch_xy_goal_tolerance = settings.latch_xy_goal_tolerance
        self.acc_lim_x = self.acc_lim_y = min(settings.max_acceleration, settings.max_translational_acceleration)
        self.acc_lim_theta = settings.max_rotational_acceleration


class EBandPlannerROS(Follower):
    """Contracts the plan as a band of bubbles that keep away from obstacles, and drives along it.

    Parameters are the original's (`EBandSettings`). The speed is `bubble_velocity_multiplier` times the free space
    around the robot at most, and lets it stop at the goal. Bubbles reach to the costmap's lethal cells, not as far as
    inflated costs say. `~NAME/eband_visualization_array` shows them.
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
        self._settings = settings = read_settings(EBandSettings, section.renamed(_OLD_NAMES))
        report_unused(node, section, "eband_local_planner", used=_USED, without_effect=_WITHOUT_EFFECT)
        self._limits_now = limits = _Limits(settings)
        self._bubbles = np.empty((0, 3))
        super().__init__(
            node,
            name,
            (section, root),
            limits,
            costmap,
            buffer,
            odom,
            stopped_speed=max(settings.trans_stopped_vel, 0.02),
            stopped_turn=max(settings.rot_stopped_vel, 0.02),
        )
        kind = "visualization_msgs/MarkerArray"
        self._markers = node.advertise(f"~{name}/eband_visualization_array", kind, queue_size=1)
        reconfigure(node, f"{node.name}/{name}", settings, self._on_settings)

    def _on_settings(self) -> None:
        vars(self._limits_now).update(vars(_Limits(self._settings)))

    @property
    def turn_limits(self) -> tuple[float, float]:
        """See `Follower`."""
        return max(self._settings.min_in_place_vel_th, 0.05), self._settings.max_vel_th

    @property
    def speed_limits(self) -> tuple[float, float]:
        """See `LocalPlanner`."""
        return self._settings.max_vel_lin, self._settings.max_vel_th

    @speed_limits.setter
    def speed_limits(self, limits: tuple[float, float]) -> None:
        self._settings.max_vel_lin, self._settings.max_vel_th = limits

    @property
    def turns_first(self) -> bool:
        """See `Follower`."""
        return self._settings.differential_drive

    def rollout_settings(self, time_s: float) -> _grids.RolloutSettings:
        """See `Follower`."""
        return _grids.RolloutSettings(
            sim_time=max(time_s, 1e-3),
            granularity=0.025,
            angular_granularity=0.1,
            acceleration=(self._limits_now.acc_lim_x, self._limits_now.acc_lim_y, self._limits_now.acc_lim_theta),
            accelerates=True,
        )

    def best(self, pose: Pose2D, plan: NDArray[np.float64]) -> Velocity | None:
        """See `Follower`."""
        path = np.vstack([[pose.x, pose.y], plan[1:, :2]]) if len(plan) > 1 else np.vstack([[pose[:2]], plan[:, :2]])
        grid = self.costmap.costmap
        obstacles = np.array(grid.origin) + (obstacle_outline(grid.cells) + 0.5) * grid.resolution_m
        self._bubbles = bubbles = relax_bubbles(
            np.ascontiguousarray(path), np.ascontiguousarray(obstacles), self._bubble_settings()
        )
        self._show()
        if len(bubbles) < 2:
            self.node.log.warn("EBandPlannerROS: no elastic band fits between the obstacles")
            return None
        velocity = self._toward(pose, plan, bubbles)
        return velocity if self._is_free(pose, velocity, 2.0 * self.period_s) else None

    def _bubble_settings(self) -> BubbleSettings:
        settings, bubbles = self._settings, BubbleSettings()
        bubbles.robot_radius = self.costmap.inscribed_m
        bubbles.num_iterations_eband_optimization = settings.num_iterations_eband_optimization
        for name in (
            "min_relative_overlap",
            "tiny_bubble_expansion",
            "internal_force_gain",
            "external_force_gain",
            "significant_force_lower_bound",
            "equilibrium_approx_max_recursion_depth",
        ):
            setattr(bubbles, name, getattr(settings, f"eband_{name}"))
        return bubbles

    def _toward(self, pose: Pose2D, plan: NDArray[np.float64], bubbles: NDArray[np.float64]) -> Velocity:
        """Return the velocity along an arc, or for a holonomic robot straight, to a point ahead on the band."""
        settings = self._settings
        along = lengths_along(bubbles)
        ahead_m = min(max(float(bubbles[0, 2]), _LOOKAHEAD_M), 2.0 * _LOOKAHEAD_M, float(along[-1]))
        x, y = (float(np.interp(ahead_m, along, bubbles[:, axis])) for axis in (0, 1))
        distance, direction = math.hypot(x - pose.x, y - pose.y), math.atan2(y - pose.y, x - pose.x)
        near = bubbles[along <= max(ahead_m, 1e-6), 2]
        space_m = max(float(near.min()), 0.0)
        rest_m = max(float(along[-1]) - 0.5 * settings.xy_goal_tolerance, 0.0)
        speed = min(
            settings.max_vel_lin,
            settings.bubble_velocity_multiplier * space_m,
            math.sqrt(2.0 * self._limits_now.acc_lim_x * rest_m),
        )
        speed = max(speed, settings.min_vel_lin)
        angle = angle_between(pose.yaw, direction)
        if not settings.differential_drive:
            end = float(plan[-1, 2])
            wanted = angle_between(pose.yaw, end if rest_m < _LOOKAHEAD_M else direction)
            turn = min(max(wanted / max(rest_m / speed, 0.5), -settings.max_vel_th), settings.max_vel_th)
            return self._accelerated((speed * math.cos(angle), speed * math.sin(angle), turn))
        if abs(angle) > settings.rotation_correction_threshold * max(settings.rotation_threshold_multiplier, 0.1):
            speed = min(speed, settings.min_vel_lin)
        turn = 2.0 * speed * math.sin(angle) / max(distance, 1e-3)
        if abs(turn) > settings.max_vel_th:
            speed *= settings.max_vel_th / abs(turn)
            turn = math.copysign(settings.max_vel_th, turn)
        return self._accelerated((speed, 0.0, turn))

    def _accelerated(self, target: Velocity) -> Velocity:
        settings = self._settings
        limits = (self._limits_now.acc_lim_x, self._limits_now.acc_lim_y, self._limits_now.acc_lim_theta)
        x, y, turn = (
            approach(now, value, limit * self.period_s)
            for now, value, limit in zip(self.odom.velocity, target, limits, strict=True)
        )
        return x, y if not settings.differential_drive else 0.0, turn

    def _show(self) -> None:
        if not self._markers.has_subscribers:
            return
        header = {"stamp": self.node.clock.now_ns(), "frame_id": self.costmap.frame}
        lifetime_ns = int(self._settings.marker_lifetime * 1e9)
        markers = [
            {
                "header": header,
                "ns": "eband_bubbles",
                "id": number,
                "type": _SPHERE,
                "pose": {"position": {"x": x, "y": y}, "orientation": {"w": 1.0}},
                "scale": {"x": 2.0 * radius, "y": 2.0 * radius, "z": 0.1},
                "color": {"g": 1.0, "a": 0.4},
                "lifetime": lifetime_ns,
            }
            for number, (x, y, radius) in enumerate(self._bubbles.tolist())
            if radius > 0.0
        ]
        self._markers.publish({"markers": markers})
