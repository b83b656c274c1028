"""libhector_gazebo_ros_imu.so: an imu with gravity and an error model."""

from typing import TYPE_CHECKING

from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import ModelHandle, Simulation, Snapshot
from trundle.spatial import ZERO, Pose

from ..gazebo_ros.link_motion import LinkMotion
from .error_model import ErrorModel
from .link_sensor import LinkSensor

if TYPE_CHECKING:
    from trundle.ros.message_types import std_srvs

_G = 9.8065
"""Standard gravity of the original [m/s²]."""


class Imu(LinkSensor):
    """Publishes sensor_msgs/Imu.

    Parameters: <bodyName> (the first link), <frameId> (the body), <topicName> imu, <serviceName> (…/calibrate),
    <updateRate> 0 (every step), and of `accel…`, `rate…` and `heading…`: <…Offset>, <…Drift>, <…DriftFrequency>,
    <…GaussianNoise>; <gaussianNoise> and <rpyOffset> as gazebo_ros_imu has them.
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        super().__init__(sim, model, node, parameters)
        self._gravity = sim.world.physics.gravity
        self._motion = LinkMotion(self.link)
        self._acceleration = ErrorModel(parameters, self.random, prefix="accel")
        self._rate = ErrorModel(parameters, self.random, prefix="rate")
        self._heading = ErrorModel(parameters, self.random, prefix="heading", axes=1)
        noise = parameters.number("gaussianNoise", 0.0)
        if noise > 0.0:
            self._acceleration.noise[:] = self._rate.noise[:] = noise
        roll, pitch, self._yaw = parameters.vector("rpyOffset", ZERO)
        self._tilt = (pitch * _G, -roll * _G)
        topic = parameters.text("topicName", "imu")
        service = parameters.text("serviceName", f"{topic}/calibrate")
        self._topic = node.advertise(self.topic(topic), "sensor_msgs/Imu", queue_size=10)
        node.advertise_service(self.topic(service), "std_srvs/Empty", self._calibrate)
        parameters.ignore("xyzOffset")

    def after_step(self, snapshot: Snapshot) -> None:
        """Publish the reading."""
        if not self._topic.has_subscribers:
            return
        dt_s = self.elapsed_s(snapshot.time_ns)
        motion = self._motion.sample(snapshot.time_ns)
        (ax, ay, az), (gx, gy, gz) = motion.acceleration, motion.in_link(self._gravity)
        specific_force = (ax - gx + self._tilt[0], ay - gy + self._tilt[1], az - gz)
        heading_error = Pose.from_rpy(0, 0, 0, 0, 0, self._yaw + float(self._heading.sample(dt_s)[0]))
        qw, qx, qy, qz = (Pose(quaternion=motion.orientation) @ heading_error).quaternion
        gravity_squared = gx * gx + gy * gy + gz * gz
        roll, pitch, _ = (
            (self._acceleration.noise**2 / gravity_squared).tolist() if gravity_squared > 0.0 else (-1.0, -1.0, 0.0)
        )
        readings = {
            "linear_acceleration": (self._acceleration, specific_force),
            "angular_velocity": (self._rate, motion.rate),
        }
        values = {
            name: dict(zip("xyz", errors.apply(value, dt_s), strict=True)) for name, (errors, value) in readings.items()
        }
        covariances = {
            f"{name}_covariance": _diagonal((errors.noise**2).tolist()) for name, (errors, _) in readings.items()
        }
        self._topic.publish(
            {
                "header": {"stamp": snapshot.time_ns, "frame_id": self.frame},
                "orientation": {"x": qx, "y": qy, "z": qz, "w": qw},
                "orientation_covariance": _diagonal([roll, pitch, float(self._heading.noise[0] ** 2)]),
                **values,
                **covariances,
            }
        )

    def reset(self) -> None:
        """Restart the drifts."""
        for model in (self._acceleration, self._rate, self._heading):
            model.reset()

    def _calibrate(self, _request: "std_srvs.EmptyRequest") -> dict[str, object]:
        self._rate.reset()
        return {}


def _diagonal(variances: list[float]) -> list[float]:
    x, y, z = variances
    return [x, 0.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, z]
