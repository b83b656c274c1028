"""Controllers of ros_control, by type."""

import importlib

from trundle.robots.parameters import ParamError

from .controller import Controller

_PACKAGE = "trundle.gazebo.plugins.ros_control"
CONTROLLERS: dict[str, str] = {
    "ackermann_steering_controller/AckermannSteeringController": f"{_PACKAGE}.ackermann_steering:AckermannSteering",
    "diff_drive_controller/DiffDriveController": f"{_PACKAGE}.diff_drive:DiffDriveController",
    "effort_controllers/GripperActionController": f"{_PACKAGE}.gripper:EffortGripper",
    "effort_controllers/JointEffortController": f"{_PACKAGE}.forward_command:EffortForward",
    "effort_controllers/JointGroupEffortController": f"{_PACKAGE}.forward_command:EffortGroup",
    "effort_controllers/JointGroupPositionController": f"{_PACKAGE}.pid_loops:EffortGroupPosition",
    "effort_controllers/JointPositionController": f"{_PACKAGE}.pid_loops:EffortPosition",
    "effort_controllers/JointTrajectoryController": f"{_PACKAGE}.trajectory:EffortTrajectory",
    "effort_controllers/JointVelocityController": f"{_PACKAGE}.pid_loops:EffortVelocity",
    "force_torque_sensor_controller/ForceTorqueSensorController": f"{_PACKAGE}.sensor_controllers:ForceTorqueSensor",
    "four_wheel_steering_controller/FourWheelSteeringController": f"{_PACKAGE}.four_wheel_steering:FourWheelDrive",
    "imu_sensor_controller/ImuSensorController": f"{_PACKAGE}.sensor_controllers:ImuSensor",
    "joint_state_controller/JointStateController": f"{_PACKAGE}.joint_state:JointStateController",
    "mecanum_drive_controller/MecanumDriveController": f"{_PACKAGE}.mecanum_drive:MecanumDriveController",
    "position_controllers/GripperActionController": f"{_PACKAGE}.gripper:PositionGripper",
    "position_controllers/JointGroupPositionController": f"{_PACKAGE}.forward_command:PositionGroup",
    "position_controllers/JointPositionController": f"{_PACKAGE}.forward_command:PositionForward",
    "position_controllers/JointTrajectoryController": f"{_PACKAGE}.trajectory:PositionTrajectory",
    "velocity_controllers/JointGroupVelocityController": f"{_PACKAGE}.forward_command:VelocityGroup",
    "velocity_controllers/JointPositionController": f"{_PACKAGE}.pid_loops:VelocityPosition",
    "velocity_controllers/JointTrajectoryController": f"{_PACKAGE}.trajectory:VelocityTrajectory",
    "velocity_controllers/JointVelocityController": f"{_PACKAGE}.forward_command:VelocityForward",
}
"""Type → "module:Class", imported on use."""


def find_controller(kind: str) -> type[Controller]:
    """Return the class of a controller type.

    Raises:
        ParamError: no such type; the message lists the types.
    """
    if kind not in CONTROLLERS:
        raise ParamError(f"no controller of type {kind!r}; types: {', '.join(sorted(CONTROLLERS))}")
    module, _, name = CONTROLLERS[kind].partition(":")
    return getattr(importlib.import_module(module), name)
