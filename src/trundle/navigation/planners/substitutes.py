"""Planners of other packages, replaced by DWAPlannerROS and NavfnROS with the limits from their parameters."""

from collections.abc import Callable, Mapping

from trundle.robots.parameters import RosParameters

_DWB = {
    "max_speed_xy": "max_vel_trans",
    "min_speed_xy": "min_vel_trans",
    "min_speed_theta": "min_vel_theta",
    "vtheta_samples": "vth_samples",
}
_RPP = {
    "desired_linear_vel": "max_vel_x",
    "rotate_to_heading_angular_vel": "max_vel_theta",
    "max_angular_accel": "acc_lim_theta",
    "goal_dist_tol": "xy_goal_tolerance",
}
_POSE_FOLLOWER = {
    "max_vel_lin": "max_vel_x",
    "min_vel_lin": "min_vel_trans",
    "max_vel_th": "max_vel_theta",
    "min_in_place_vel_th": "min_vel_theta",
    "max_acceleration": "acc_lim_x",
    "max_rotational_acceleration": "acc_lim_theta",
    "tolerance_trans": "xy_goal_tolerance",
    "tolerance_rot": "yaw_goal_tolerance",
}


def _like_dwa(names: Mapping[str, str]) -> Callable[[RosParameters], RosParameters]:
    return lambda section: _on_wheels(section.renamed(names))


def _on_wheels(section: RosParameters) -> RosParameters:
    """Return parameters with defaults: no sideways motion, and the speed limit ahead as the limit in all directions."""
    sideways = section.number("max_vel_y", 0.0)
    still = {"max_vel_y": 0.0, "min_vel_y": 0.0, "vy_samples": 0} if sideways == 0.0 else {}
    return section.with_defaults({"max_vel_trans": max(section.number("max_vel_x", 0.55), sideways), **still})


SUBSTITUTES: dict[str, Callable[[RosParameters], RosParameters]] = {
    "MpcLocalPlannerROS": _like_dwa({}),
    "PoseFollower": _like_dwa(_POSE_FOLLOWER),
    "RegulatedPurePursuitController": _like_dwa(_RPP),
    "NeoLocalPlanner": _like_dwa({}),
    "MIRPlannerROS": _like_dwa({}),
    "DWBLocalPlanner": _like_dwa(_DWB),
}
"""Class of a local planner → its parameters as DWAPlannerROS'."""
GLOBAL_SUBSTITUTES = frozenset({"SBPLLatticePlanner", "GlobalPlannerAdapter"})
"""Classes of global planners that NavfnROS stands in for."""
