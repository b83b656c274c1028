"""Controllers of ros_control, by type."""

import importlib

from trundle.robots.parameters import ParamError

from .controller import Controller

_HERE = "trundle.gazebo.plugins.ros_control"
CONTROLLERS: dict[str, str] = {
    "ackermann_steering_controller/AckermannSteeringController": f"{_HERE}.ackermann_steering:AckermannSteering",
    "diff_drive_controller/DiffDriveController": f"{_HERE}.diff_drive:DiffDriveController",
    "effort_controllers/GripperActionController": f"{_HERE}.gripper:EffortGripper",
    "effort_controllers/JointEffortController": f"{_HERE}.forward_command:EffortForward",
    "effort_controllers/JointGroupEffortController": f"{_HERE}.forward_command:EffortGroup",
    "effort_controllers/JointGroupPositionController": f"{_HERE}.pid_loops:EffortGroupPosition",
    "effort_controllers/JointPositionController": f"{_HERE}.pid_loops:EffortPosition",
    "effort_controllers/JointTrajectoryController": f"{_HERE}.trajectory:EffortTrajectory",
    "effort_controllers/JointVelocityController": f"{_HERE}.pid_loops:EffortVelocity",
    "force_torque_sensor_controller/ForceTorqueSensorController": f"{_HERE}.sensor_controllers:ForceTorqueSensor",
    "four_wheel_steering_controller/FourWheelSteeringController": f"{_HERE}.four_wheel_steering:FourWheelDrive",
    "imu_sensor_controller/ImuSensorController": f"{_HERE}.sensor_controllers:ImuSensor",
    "joint_state_controller/JointStateController": f"{_HERE}.joint_state:JointStateController",
    "mecanum_drive_controller/MecanumDriveController": f"{_HERE}.mecanum_drive:MecanumDriveController",
    "position_controllers/GripperActionController": f"{_HERE}.gripper:PositionGripper",
    "position_controllers/JointGroupPositionController": f"{_HERE}.forward_command:PositionGroup",
    "position_controllers/JointPositionController": f"{_HERE}.forward_command:PositionForward",
    "position_controllers/JointTrajectoryController": f"{_HERE}.trajectory:PositionTrajectory",
    "velocity_controllers/JointGroupVelocityController": f"{_HERE}.forward_command:VelocityGroup",
    "velocity_controllers/JointPositionController": f"{_HERE}.pid_loops:VelocityPosition",
    "velocity_controllers/JointTrajectoryController": f"{_HERE}.trajectory:VelocityTrajectory",
    "velocity_controllers/JointVelocityController": f"{_HERE}.forward_command:VelocityForward",
}
"""Type → "module:Class", imported on use."""


def find_controller(kind: str) -> type[Controller]:
    """Class of a controller's type.

    Raises:
        ParamError: no such type; the message lists those there are.
    """
    if kind not in CONTROLLERS:
        raise ParamError(f"no controller of type {kind!r}; there are: {', '.join(sorted(CONTROLLERS))}")
    module, _, name = CONTROLLERS[kind].partition(":")
    return getattr(importlib.import_module(module), name)
