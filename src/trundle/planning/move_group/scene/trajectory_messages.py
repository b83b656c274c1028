"""Paths as moveit_msgs/RobotTrajectory: joints of one variable, and those of several as transforms."""

from typing import TYPE_CHECKING, Any

from trundle.spatial import NS_PER_S

from ..controllers import JointPath, path_message
from .state_messages import transform_fields

if TYPE_CHECKING:
    from trundle.planning.robot_model import JointModel, RobotModel


def trajectory_fields(model: "RobotModel", path: JointPath) -> dict[str, Any]:
    """Return the fields of a moveit_msgs/RobotTrajectory.

    Planar and floating joints are in its multi_dof_joint_trajectory, in the frame of their first parent; velocities are
    given for planar ones.
    """
    several = [joint for joint in model.joints if len(joint.variables) > 1 and joint.variables[0] in path.joints]
    taken = {variable for joint in several for variable in joint.variables}
    fields: dict[str, Any] = {}
    if len(taken) < len(path.joints):
        single = path.select(name for name in path.joints if name not in taken)
        fields["joint_trajectory"] = path_message(single, frame=model.model_frame)
    if several:
        fields["multi_dof_joint_trajectory"] = {
            "header": {"frame_id": model.model_frame},
            "joint_names": [joint.name for joint in several],
            "points": [_point(path, several, index) for index in range(len(path.times_s))],
        }
    return fields


def _point(path: JointPath, joints: "list[JointModel]", index: int) -> dict[str, Any]:
    columns = [[path.joints.index(variable) for variable in joint.variables] for joint in joints]
    point: dict[str, Any] = {
        "transforms": [transform_fields(path.positions[index, column].tolist()) for column in columns],
        "time_from_start": round(float(path.times_s[index]) * NS_PER_S),
    }
    if all(joint.type == "planar" for joint in joints):
        for name, rows in (("velocities", path.velocities), ("accelerations", path.accelerations)):
            if rows is not None:
                point[name] = [_twist(rows[index, column].tolist()) for column in columns]
    return point


def _twist(rates: list[float]) -> dict[str, Any]:
    x, y, turn = rates
    return {"linear": {"x": x, "y": y, "z": 0.0}, "angular": {"x": 0.0, "y": 0.0, "z": turn}}
