"""Parameters of teb_local_planner."""

import math
from typing import Annotated

import msgspec
import numpy as np
from msgspec import Meta
from numpy.typing import NDArray

from trundle.robots.parameters import ParamError, RosParameters

from ...costmap.footprint import corners
from ._bands import BandSettings, RobotBody

_Positive = Annotated[float, Meta(ge=0.0)]
_Speed = Annotated[float, Meta(ge=0.01, le=100.0)]
_Weight = Annotated[float, Meta(ge=0.0, le=1000.0)]
_Unit = Annotated[float, Meta(ge=0.0, le=1.0)]


class TebSettings(msgspec.Struct, kw_only=True):
    """Parameters, with the original's defaults; lengths [m], times [s], angles [rad]."""

    teb_autosize: bool = True
    dt_ref: Annotated[float, Meta(ge=0.01, le=1.0)] = 0.3
    dt_hysteresis: Annotated[float, Meta(ge=0.002, le=0.5)] = 0.1
    min_samples: Annotated[int, Meta(ge=3, le=1000)] = 3
    max_samples: Annotated[int, Meta(ge=3, le=1000)] = 500
    global_plan_overwrite_orientation: bool = True
    allow_init_with_backwards_motion: bool = False
    global_plan_viapoint_sep: Annotated[float, Meta(le=5.0)] = -0.1
    max_global_plan_lookahead_dist: Annotated[float, Meta(ge=0.0, le=50.0)] = 3.0
    force_reinit_new_goal_dist: Annotated[float, Meta(ge=0.0, le=10.0)] = 1.0
    force_reinit_new_goal_angular: Annotated[float, Meta(ge=0.0, le=2.0 * math.pi)] = 0.5 * math.pi
    feasibility_check_no_poses: Annotated[int, Meta(ge=-1, le=50)] = 5
    exact_arc_length: bool = False
    publish_feedback: bool = False
    control_look_ahead_poses: Annotated[int, Meta(ge=1, le=100)] = 1
    max_vel_x: _Speed = 0.4
    max_vel_x_backwards: _Speed = 0.2
    max_vel_y: Annotated[float, Meta(ge=0.0, le=100.0)] = 0.0
    max_vel_trans: Annotated[float, Meta(ge=0.0, le=100.0)] = 0.0
    max_vel_theta: _Speed = 0.3
    acc_lim_x: _Speed = 0.5
    acc_lim_y: _Speed = 0.5
    acc_lim_theta: _Speed = 0.5
    min_turning_radius: Annotated[float, Meta(ge=0.0, le=50.0)] = 0.0
    wheelbase: Annotated[float, Meta(ge=-10.0, le=10.0)] = 1.0
    cmd_angle_instead_rotvel: bool = False
    use_proportional_saturation: bool = False
    xy_goal_tolerance: Annotated[float, Meta(ge=0.001, le=10.0)] = 0.2
    yaw_goal_tolerance: Annotated[float, Meta(ge=0.001, le=3.2)] = 0.1
    free_goal_vel: bool = False
    trans_stopped_vel: _Positive = 0.1
    theta_stopped_vel: _Positive = 0.1
    min_obstacle_dist: Annotated[float, Meta(ge=0.0, le=10.0)] = 0.5
    inflation_dist: Annotated[float, Meta(ge=0.0, le=15.0)] = 0.6
    include_costmap_obstacles: bool = True
    obstacle_association_force_inclusion_factor: Annotated[float, Meta(ge=0.0, le=100.0)] = 1.5
    obstacle_association_cutoff_factor: Annotated[float, Meta(ge=1.0, le=100.0)] = 5.0
    costmap_obstacles_behind_robot_dist: Annotated[float, Meta(ge=0.0, le=20.0)] = 1.5
    no_inner_iterations: Annotated[int, Meta(ge=1, le=100)] = 5
    no_outer_iterations: Annotated[int, Meta(ge=1, le=100)] = 4
    optimization_activate: bool = True
    penalty_epsilon: _Unit = 0.1
    obstacle_cost_exponent: Annotated[float, Meta(ge=0.01, le=100.0)] = 1.0
    weight_max_vel_x: _Weight = 2.0
    weight_max_vel_y: _Weight = 2.0
    weight_max_vel_theta: _Weight = 1.0
    weight_acc_lim_x: _Weight = 1.0
    weight_acc_lim_y: _Weight = 1.0
    weight_acc_lim_theta: _Weight = 1.0
    weight_kinematics_nh: Annotated[float, Meta(ge=0.0, le=10000.0)] = 1000.0
    weight_kinematics_forward_drive: _Weight = 1.0
    weight_kinematics_turning_radius: _Weight = 1.0
    weight_optimaltime: _Weight = 1.0
    weight_shortest_path: Annotated[float, Meta(ge=0.0, le=100.0)] = 0.0
    weight_obstacle: _Weight = 50.0
    weight_inflation: Annotated[float, Meta(ge=0.0, le=10.0)] = 0.1
    weight_viapoint: _Weight = 1.0
    weight_adapt_factor: Annotated[float, Meta(ge=1.0, le=100.0)] = 2.0
    enable_homotopy_class_planning: bool = True
    max_number_classes: Annotated[int, Meta(ge=1, le=100)] = 5
    selection_cost_hysteresis: Annotated[float, Meta(ge=0.0, le=2.0)] = 1.0
    selection_prefer_initial_plan: _Unit = 0.95
    selection_obst_cost_scale: _Weight = 100.0
    switching_blocking_period: Annotated[float, Meta(ge=0.0, le=60.0)] = 0.0
    shrink_horizon_backup: bool = True
    shrink_horizon_min_duration: _Positive = 10.0


_WITHOUT_EFFECT = """
    complete_global_plan costmap_converter_plugin costmap_converter_rate costmap_converter_spin_thread
    delete_detours_backwards detours_orientation_tolerance dynamic_obstacle_inflation_dist enable_multithreading
    global_plan_prune_distance h_signature_prescaler h_signature_threshold include_dynamic_obstacles
    is_footprint_dynamic legacy_obstacle_association length_start_orientation_vector max_number_plans_in_current_class
    max_ratio_detours_duration_best_duration min_resolution_collision_check_angular obstacle_heading_threshold
    obstacle_keypoint_offset obstacle_poses_affected obstacle_proximity_lower_bound obstacle_proximity_ratio_max_vel
    obstacle_proximity_upper_bound optimization_verbose oscillation_filter_duration oscillation_omega_eps
    oscillation_recovery oscillation_recovery_min_duration oscillation_v_eps roadmap_graph_area_length_scale
    roadmap_graph_area_width roadmap_graph_no_samples selection_alternative_time_cost selection_dropping_probability
    selection_viapoint_cost_scale simple_exploration transform_tolerance via_points_ordered viapoints_all_candidates
    visualize_hc_graph visualize_with_time_as_z_axis_scale weight_dynamic_obstacle weight_dynamic_obstacle_inflation
    weight_prefer_rotdir weight_velocity_obstacle_ratio
"""
WITHOUT_EFFECT = frozenset(_WITHOUT_EFFECT.split())
"""Parameters of the original that are read by nothing."""
USED = frozenset({*TebSettings.__struct_fields__, "footprint_model", "map_frame", "odom_topic"})
"""Parameters that act here."""


def band_settings(settings: TebSettings) -> BandSettings:
    """Return the settings of the optimization, which have the same names."""
    band = BandSettings()
    for name in TebSettings.__struct_fields__:
        if hasattr(band, name):
            setattr(band, name, getattr(settings, name))
    return band


def read_body(section: RosParameters, footprint: NDArray[np.float64]) -> RobotBody:
    """Read `footprint_model`, in every form of the original; `costmap_2d` is the costmap's footprint (n, 2) [m].

    Raises:
        ParamError: the type is unknown, or a value is invalid.
    """
    model = section.section("footprint_model")
    kind = model.text("type", "point")
    lines: list[tuple[float, float, float, float, float]]
    if kind == "point":
        lines = [(0.0, 0.0, 0.0, 0.0, 0.0)]
    elif kind == "circular":
        lines = [(0.0, 0.0, 0.0, 0.0, model.number("radius", minimum=0.0))]
    elif kind == "two_circles":
        front, rear = model.number("front_offset"), -model.number("rear_offset")
        radii = model.number("front_radius", minimum=0.0), model.number("rear_radius", minimum=0.0)
        lines = [(front, 0.0, front, 0.0, radii[0]), (rear, 0.0, rear, 0.0, radii[1])]
    elif kind == "line":
        ends = [model.items(name) for name in ("line_start", "line_end")]
        points = corners([*ends, ends[0]], f"parameter {model.namespace}/line_start, line_end")
        lines = [(float(points[0, 0]), float(points[0, 1]), float(points[1, 0]), float(points[1, 1]), 0.0)]
    elif kind in ("polygon", "costmap_2d"):
        vertices = footprint
        if kind == "polygon":
            vertices = corners(model.items("vertices"), f"parameter {model.namespace}/vertices")
        if not len(vertices):
            raise ParamError(f"{model.namespace}: a footprint of type {kind} needs at least three vertices")
        following = np.roll(vertices, -1, axis=0)
        return RobotBody(np.hstack([vertices, following, np.zeros((len(vertices), 1))]), is_closed=True)
    else:
        raise ParamError(
            f"parameter {model.namespace}/type: no footprint model {kind!r}; there are: point, circular, two_circles, "
            "line, polygon, costmap_2d"
        )
    return RobotBody(np.array(lines), is_closed=False)
