"""libgazebo_ros_skid_steer_drive.so: cmd_vel in; the speeds of four wheels, odometry and tf out."""

from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.control import DifferentialDrive
from trundle.sim.simulation import ModelHandle, Simulation, Snapshot

from .namespaces import rate_to_period_ns
from .odometry import LARGE_VARIANCE, OdometryTopic, ground_truth
from .ros_plugin import RosPlugin, plugin_names
from .twist_command import TwistCommand


class SkidSteerDrive(RosPlugin):
    """Drives the wheels of each side at one speed.

    Parameters, with gazebo_ros' defaults: <leftFrontJoint> left_front_joint and so on, <wheelSeparation> 0.4,
    <wheelDiameter> 0.15, <torque> 5, <commandTopic> cmd_vel, <odometryTopic> odom, <odometryFrame> odom,
    <robotBaseFrame> base_footprint, <updateRate> 100, <broadcastTF> false, <covariance_x> and <covariance_y> 1e-4,
    <covariance_yaw> 0.01.
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        names = plugin_names(sim, model, node, parameters)

        def wheel(side: str, row: str) -> str:
            return parameters.text(f"{side}{row}Joint", f"{side}_{row.lower()}_joint")

        self._model = model
        self._sides = [[model.joint(wheel(side, row)) for row in ("Front", "Rear")] for side in ("left", "right")]
        self._drive = DifferentialDrive(
            separation=parameters.number("wheelSeparation", 0.4),
            wheel_radius=parameters.number("wheelDiameter", 0.15) / 2,
        )
        self._torque = parameters.number("torque", 5.0)
        self.period_ns = rate_to_period_ns(parameters.number("updateRate", 100.0))
        self._command = TwistCommand.from_tag(parameters, names)
        x, y, yaw = (
            parameters.number("covariance_x", 1e-4),
            parameters.number("covariance_y", 1e-4),
            parameters.number("covariance_yaw", 0.01),
        )
        self._odometry = OdometryTopic.from_tag(
            parameters,
            names,
            variances=(x, y, LARGE_VARIANCE, LARGE_VARIANCE, LARGE_VARIANCE, yaw),
            with_tf=parameters.flag("broadcastTF", default=False),
        )

    def before_step(self, sim: Simulation) -> None:
        """Set all wheels' speeds."""
        del sim
        speeds = self._drive.wheel_speeds(self._command.forward, self._command.yaw_rate)
        for side, speed in zip(self._sides, speeds, strict=True):
            for wheel in side:
                wheel.command_velocity(speed, max_effort=self._torque)

    def after_step(self, snapshot: Snapshot) -> None:
        """Publish odometry."""
        self._odometry.publish(snapshot.time_ns, *ground_truth(self._model))

    def reset(self) -> None:
        """Stop."""
        self._command.stop()
