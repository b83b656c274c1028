"""New times for a trajectory."""

from typing import TYPE_CHECKING, Any

import numpy as np

import rospy
from trundle.planning.trajectories import find_method, motion_limits, parameterize

if TYPE_CHECKING:
    from trundle.planning.robot_model import RobotModel

RETIMING_ALGORITHMS = (
    "iterative_time_parameterization",
    "iterative_spline_parameterization",
    "time_optimal_trajectory_generation",
)


def retimed(
    model: "RobotModel",
    trajectory: Any,
    velocity_scaling: float,
    acceleration_scaling: float,
    algorithm: str,
) -> Any:
    """Return a moveit_msgs/RobotTrajectory with new times, velocities and accelerations.

    Args:
        model: the robot.
        trajectory: moveit_msgs/RobotTrajectory.
        velocity_scaling: share of the greatest velocities, in (0, 1].
        acceleration_scaling: share of the greatest accelerations, in (0, 1].
        algorithm: one of `RETIMING_ALGORITHMS`.

    Raises:
        TrundleError: a joint is unknown, or the points do not fit the joints.
    """
    joints = trajectory.joint_trajectory
    waypoints = np.array([list(point.positions) for point in joints.points], dtype=np.float64)
    if len(waypoints) < 2:
        return trajectory
    method, note = find_method(algorithm)
    if note:
        rospy.logwarn(note)
    result = parameterize(
        waypoints,
        motion_limits(model, joints.joint_names),
        velocity_scaling=velocity_scaling,
        acceleration_scaling=acceleration_scaling,
        method=method,
    )
    kind = type(joints.points[0])
    joints.points = []
    for time_s, positions, velocities, accelerations in zip(
        result.times, result.positions, result.velocities, result.accelerations, strict=True
    ):
        point = kind()
        point.positions, point.velocities = positions.tolist(), velocities.tolist()
        point.accelerations = accelerations.tolist()
        point.time_from_start = rospy.Duration.from_sec(float(time_s))
        joints.points.append(point)
    return trajectory
