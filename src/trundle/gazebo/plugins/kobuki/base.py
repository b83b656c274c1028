"""Kobuki's wheels, odometry and gyro; its bumpers, cliff and wheel drop sensors are in `sensors`."""

import math
from typing import TYPE_CHECKING, Any

from trundle.base.diagnostics import UsageError
from trundle.robots.parameters import TagParameters
from trundle.ros import Message, Node
from trundle.sim.control import DifferentialDrive
from trundle.sim.simulation import ModelHandle, Simulation, Snapshot
from trundle.spatial import Pose, Twist

from ..gazebo_ros.namespaces import rate_to_period_ns
from ..gazebo_ros.odometry import OdometryTopic
from ..gazebo_ros.ros_plugin import RosPlugin, plugin_names
from .sensors import KobukiSensors, ModelSensor

if TYPE_CHECKING:
    from trundle.ros.message_types import geometry_msgs, kobuki_msgs, sensor_msgs

_BASE = "mobile_base"
_POSE_VARIANCES = (0.1, 0.1, 1e6, 1e6, 1e6, 0.05)
_GYRO_COVARIANCE = [1e6, 0.0, 0.0, 0.0, 1e6, 0.0, 0.0, 0.0, 0.05]
_ON = 1
"""kobuki_msgs/MotorPower.ON"""


class Kobuki(RosPlugin):
    """Drives by `mobile_base/commands/velocity`; publishes odom, joint_states and sensors on `mobile_base/…`.

    Parameters: <left_wheel_joint_name>, <right_wheel_joint_name>, <wheel_separation> [m], <wheel_diameter> [m],
    <torque> [N·m], <velocity_command_timeout> [s], <imu_name> and those of `KobukiSensors`, all required;
    <publish_tf> false, <update_rate> 0 (every step). As in the original, odometry takes the heading
    from the gyro and the distance from the wheels.
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        wheels = ("left_wheel_joint_name", "right_wheel_joint_name")
        self._wheels = [model.joint(parameters.text(name)) for name in wheels]
        self._drive = DifferentialDrive(
            separation=parameters.number("wheel_separation", above=0.0),
            wheel_radius=parameters.number("wheel_diameter", above=0.0) / 2,
        )
        self._torque = parameters.number("torque")
        self._timeout_s = parameters.number("velocity_command_timeout")
        self.period_ns = rate_to_period_ns(parameters.number("update_rate", 0.0))
        self._node = node
        names = plugin_names(sim, model, node, parameters)
        self._odometry = OdometryTopic(
            names,
            "odom",
            frame="odom",
            base="base_footprint",
            variances=_POSE_VARIANCES,
            twist_variances=(0.0,) * 6,
            with_tf=parameters.flag("publish_tf", default=False),
        )
        self._states = names.advertise("sensor_msgs/JointState", "joint_states")
        self._imu = names.advertise("sensor_msgs/Imu", f"{_BASE}/sensors/imu_data")
        self._frame = names.frame("base_link")

        def sensor(name: str) -> ModelSensor:
            return _find_sensor(model, parameters.text(name))

        self._sensors = KobukiSensors(model, names, _BASE, parameters, sensor)
        self._gyro: Message | None = None
        node.subscribe(sensor("imu_name").topic("imu"), "sensor_msgs/Imu", self._on_imu, queue_size=1)
        commands = f"{_BASE}/commands"
        names.subscribe(f"{commands}/velocity", "geometry_msgs/Twist", self._on_command, queue_size=100)
        names.subscribe(f"{commands}/motor_power", "kobuki_msgs/MotorPower", self._on_motor_power, queue_size=10)
        names.subscribe(f"{commands}/reset_odometry", "std_msgs/Empty", self._reset_odometry, queue_size=10)
        self.reset()

    def before_step(self, sim: Simulation) -> None:
        """Set the wheels' speeds; a command older than the timeout counts as zero."""
        is_timed_out = (sim.time_ns - self._commanded_ns) / 1e9 > self._timeout_s
        speeds = (0.0, 0.0) if is_timed_out or not self._is_powered else self._speeds
        for wheel, speed in zip(self._wheels, speeds, strict=True):
            wheel.command_velocity(speed, max_effort=self._torque)

    def after_step(self, snapshot: Snapshot) -> None:
        """Publish joint states, odometry, imu and sensors."""
        time_ns = snapshot.time_ns
        self._publish_joint_states(time_ns)
        self._publish_odometry(time_ns)
        if self._gyro is not None and self._imu.has_subscribers:
            self._imu.publish(
                {
                    "header": {"stamp": time_ns, "frame_id": self._frame},
                    "orientation": self._gyro.orientation,
                    "orientation_covariance": _GYRO_COVARIANCE,
                    "angular_velocity": self._gyro.angular_velocity,
                    "angular_velocity_covariance": _GYRO_COVARIANCE,
                    "linear_acceleration": self._gyro.linear_acceleration,
                }
            )
        self._sensors.publish(time_ns)

    def reset(self) -> None:
        """Stop with power on, and restart odometry at its origin."""
        self._speeds, self._commanded_ns, self._is_powered = (0.0, 0.0), 0, True
        self._odometry_pose = [0.0, 0.0, 0.0]
        self._last_positions = [wheel.position for wheel in self._wheels]
        self._published_ns = 0
        self._sensors.reset()

    def _publish_joint_states(self, time_ns: int) -> None:
        if self._states.has_subscribers:
            self._states.publish(
                {
                    "header": {"stamp": time_ns, "frame_id": self._frame},
                    "name": [wheel.name for wheel in self._wheels],
                    "position": [wheel.position for wheel in self._wheels],
                    "velocity": [wheel.velocity for wheel in self._wheels],
                    "effort": [0.0, 0.0],
                }
            )

    def _publish_odometry(self, time_ns: int) -> None:
        """Integrate wheels and gyro since the last call, and publish."""
        positions, elapsed = [wheel.position for wheel in self._wheels], (time_ns - self._published_ns) / 1e9
        distance = (
            sum(current - last for current, last in zip(positions, self._last_positions, strict=True))
            / 2
            * self._drive.wheel_radius
        )
        self._last_positions, self._published_ns = positions, time_ns
        yaw_rate = 0.0 if self._gyro is None else float(self._gyro.angular_velocity.z)
        yaw = self._odometry_pose[2]
        self._odometry_pose = [
            self._odometry_pose[0] + distance * math.cos(yaw),
            self._odometry_pose[1] + distance * math.sin(yaw),
            yaw + yaw_rate * max(elapsed, 0.0),
        ]
        x, y, yaw = self._odometry_pose
        pose = Pose((x, y, 0.0), (math.cos(yaw / 2), 0.0, 0.0, math.sin(yaw / 2)))
        speed = distance / elapsed if elapsed > 0.0 else 0.0
        self._odometry.publish(time_ns, pose, Twist((speed, 0.0, 0.0), (0.0, 0.0, yaw_rate)))

    def _on_command(self, twist: "geometry_msgs.Twist") -> None:
        forward, yaw_rate = float(twist.linear.x), float(twist.angular.z)
        if math.isfinite(forward) and math.isfinite(yaw_rate):
            self._speeds = self._drive.wheel_speeds(forward, yaw_rate)
            self._commanded_ns = self._node.clock.now_ns()

    def _on_motor_power(self, message: "kobuki_msgs.MotorPower") -> None:
        self._is_powered = message.state == _ON

    def _on_imu(self, message: "sensor_msgs.Imu") -> None:
        self._gyro = message

    def _reset_odometry(self, _: Any) -> None:
        self._odometry_pose = [0.0, 0.0, 0.0]


def _find_sensor(model: ModelHandle, name: str) -> ModelSensor:
    """Sensor of a model by name.

    Raises:
        UsageError: no such sensor; the message lists the model's sensors.
    """
    sensors = [ModelSensor(model.model, link.name, sensor) for link in model.model.links for sensor in link.sensors]
    for sensor in sensors:
        if sensor.sensor.name == name:
            return sensor
    raise UsageError(
        f"no sensor {name!r}; sensors here: {', '.join(sensor.sensor.name for sensor in sensors) or 'none'}"
    )
