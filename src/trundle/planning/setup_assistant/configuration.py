"""YAML files of a configuration, by MoveIt's names."""

from typing import Any, Literal, TypeAlias

import yaml

from trundle.planning.robot_model import RobotModel, Srdf

Interface: TypeAlias = Literal["position", "velocity", "effort"]
_PLANNERS: dict[str, dict[str, Any]] = {
    "AnytimePathShortening": {"shortcut": True, "hybridize": True, "max_hybrid_paths": 24, "num_planners": 4},
    "SBL": {"range": 0.0},
    "EST": {"range": 0.0, "goal_bias": 0.05},
    "LBKPIECE": {"range": 0.0, "border_fraction": 0.9, "min_valid_path_fraction": 0.5},
    "BKPIECE": {
        "range": 0.0,
        "border_fraction": 0.9,
        "failed_expansion_score_factor": 0.5,
        "min_valid_path_fraction": 0.5,
    },
    "KPIECE": {
        "range": 0.0,
        "goal_bias": 0.05,
        "border_fraction": 0.9,
        "failed_expansion_score_factor": 0.5,
        "min_valid_path_fraction": 0.5,
    },
    "RRT": {"range": 0.0, "goal_bias": 0.05},
    "RRTConnect": {"range": 0.0},
    "RRTstar": {"range": 0.0, "goal_bias": 0.05, "delay_collision_checking": 1},
    "TRRT": {
        "range": 0.0,
        "goal_bias": 0.05,
        "max_states_failed": 10,
        "temp_change_factor": 2.0,
        "min_temperature": 1e-10,
        "init_temperature": 1e-5,
        "frountier_threshold": 0.0,  # so spelled by OMPL's parameters
        "frountierNodeRatio": 0.1,
    },
    "PRM": {"max_nearest_neighbors": 10},
    "PRMstar": {},
    "FMT": {"num_samples": 1000, "radius_multiplier": 1.1, "nearest_k": 1, "cache_cc": 1, "heuristics": 0},
    "BFMT": {"num_samples": 1000, "radius_multiplier": 1.0, "nearest_k": 1, "balanced": 0, "optimality": 1},
    "BiTRRT": {"range": 0.0, "temp_change_factor": 0.1, "init_temperature": 100},
    "BiEST": {"range": 0.0},
    "LazyPRM": {"range": 0.0},
    "LazyPRMstar": {},
}
"""OMPL's planners with their default parameters (https://ompl.kavrakilab.org/planners.html)."""
_SCALING = 0.1
_SENSORS = """\
# Point clouds and depth images, of which obstacles are made; MoveIt's perception tutorial has their settings.
sensors: []
"""
_GAINS = {"p": 100, "d": 1, "i": 1, "i_clamp": 1}


def configuration(model: RobotModel, srdf: Srdf, interface: Interface) -> dict[str, str]:
    """Return file name → text of the files in config/.

    Args:
        model: robot with the groups of the SRDF.
        srdf: SRDF.
        interface: what the robot's joints are commanded by.
    """
    arms = [group.name for group in srdf.groups if model.groups[group.name].end_effector is None]
    return {
        "kinematics.yaml": _text({name: _kinematics() for name in arms}),
        "joint_limits.yaml": _joint_limits(model),
        "cartesian_limits.yaml": _text(
            {
                "cartesian_limits": {
                    "max_trans_vel": 1.0,
                    "max_trans_acc": 2.25,
                    "max_trans_dec": -5.0,
                    "max_rot_vel": 1.57,
                }
            }
        ),
        "ompl_planning.yaml": _ompl(model, srdf),
        "fake_controllers.yaml": _fake_controllers(model, srdf),
        "simple_moveit_controllers.yaml": _simple_controllers(model, srdf),
        "ros_controllers.yaml": _ros_controllers(model, srdf, interface),
        "sensors_3d.yaml": _SENSORS,
    }


def controller_names(srdf: Srdf) -> list[str]:
    """Return a controller's name for each group."""
    return [f"{group.name}_controller" for group in srdf.groups]


def _text(values: object) -> str:
    return yaml.safe_dump(values, sort_keys=False, default_flow_style=None, width=110, allow_unicode=True)


def _kinematics() -> dict[str, Any]:
    return {
        "kinematics_solver": "kdl_kinematics_plugin/KDLKinematicsPlugin",
        "kinematics_solver_search_resolution": 0.005,
        "kinematics_solver_timeout": 0.005,
    }


def _joint_limits(model: RobotModel) -> str:
    limits: dict[str, dict[str, Any]] = {}
    for joint in model.joints:
        for variable, velocity in zip(joint.variables, joint.max_velocity, strict=True):
            if joint.passive or joint.mimic is not None or not joint.parent_link:
                continue
            limits[variable] = {
                "has_velocity_limits": velocity is not None,
                "max_velocity": velocity or 0.0,
                "has_acceleration_limits": False,
                "max_acceleration": 0.0,
            }
    defaults = {"default_velocity_scaling_factor": _SCALING, "default_acceleration_scaling_factor": _SCALING}
    about = "# Velocities are the URDF's; it has no accelerations: without limits here, 1 rad/s² or m/s² is assumed.\n"
    return about + _text({**defaults, "joint_limits": limits})


def _ompl(model: RobotModel, srdf: Srdf) -> str:
    values: dict[str, Any] = {
        "planner_configs": {
            name: {"type": f"geometric::{name}", **parameters} for name, parameters in _PLANNERS.items()
        }
    }
    for group in srdf.groups:
        joints = model.groups[group.name].joints
        values[group.name] = {"default_planner_config": "RRTConnect", "planner_configs": list(_PLANNERS)}
        if len(joints) >= 2:
            values[group.name]["projection_evaluator"] = f"joints({joints[0]},{joints[1]})"
        values[group.name]["longest_valid_segment_fraction"] = 0.005
    return _text(values)


def _fake_controllers(model: RobotModel, srdf: Srdf) -> str:
    controllers = [
        {
            "name": f"fake_{group.name}_controller",
            "type": "$(arg fake_execution_type)",
            "joints": list(model.groups[group.name].joints),
        }
        for group in srdf.groups
    ]
    initial = {state.group: state.name for state in reversed(srdf.states)}
    poses = [{"group": group.name, "pose": initial[group.name]} for group in srdf.groups if group.name in initial]
    return _text({"controller_list": controllers, "initial": poses})


def _simple_controllers(model: RobotModel, srdf: Srdf) -> str:
    controllers = [
        {
            "name": name,
            "action_ns": "follow_joint_trajectory",
            "type": "FollowJointTrajectory",
            "default": True,
            "joints": list(model.groups[group.name].joints),
        }
        for name, group in zip(controller_names(srdf), srdf.groups, strict=True)
    ]
    return _text({"controller_list": controllers})


def _ros_controllers(model: RobotModel, srdf: Srdf, interface: Interface) -> str:
    values: dict[str, Any] = {
        "joint_state_controller": {"type": "joint_state_controller/JointStateController", "publish_rate": 50}
    }
    for name, group in zip(controller_names(srdf), srdf.groups, strict=True):
        joints = list(model.groups[group.name].joints)
        values[name] = {"type": f"{interface}_controllers/JointTrajectoryController", "joints": joints}
        if interface != "position":
            values[name]["gains"] = {joint: dict(_GAINS) for joint in joints}
    return _text(values)
