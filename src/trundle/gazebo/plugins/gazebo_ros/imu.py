"""libgazebo_ros_imu.so: orientation, rate and acceleration of a link, without gravity as in the original."""

from typing import TYPE_CHECKING

import numpy as np

from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import ModelHandle, Simulation, Snapshot
from trundle.spatial import ZERO, Pose, Vector3

from .link_motion import LinkMotion
from .namespaces import rate_to_period_ns, read_offset
from .ros_plugin import RosPlugin, plugin_names

if TYPE_CHECKING:
    from trundle.ros.message_types import std_srvs


class Imu(RosPlugin):
    """Publishes sensor_msgs/Imu.

    Parameters, with gazebo_ros' defaults: <bodyName> (required), <topicName> and <serviceName> /default_imu,
    <frameName> (the body), <rpyOffset> 0 0 0 (or <rpyOffsets>; turns the orientation, in world axes), <gaussianNoise>
    0, <updateRate> 0 (every step). As in the original, <xyzOffset> has no effect.
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        link = model.link(parameters.text("bodyName"))
        names = plugin_names(sim, model, node, parameters)
        self._motion = LinkMotion(link)
        self._frame = names.frame(parameters.text("frameName", link.name))
        self._offset = read_offset(parameters, ("rpyOffset",))
        self._noise = parameters.number("gaussianNoise", 0.0)
        self._random = np.random.default_rng(sim.seed)
        self.period_ns = rate_to_period_ns(parameters.number("updateRate", 0.0))
        self._topic = names.advertise("sensor_msgs/Imu", parameters.text("topicName", "/default_imu"))
        service = names.topic(parameters.text("serviceName", "/default_imu"))
        node.advertise_service(service, "std_srvs/Empty", _calibrated)
        parameters.ignore("xyzOffset", "xyzOffsets")

    def after_step(self, snapshot: Snapshot) -> None:
        """Publish the reading."""
        if not self._topic.has_subscribers:
            return
        motion = self._motion.sample(snapshot.time_ns)
        qw, qx, qy, qz = (self._offset @ Pose(quaternion=motion.orientation)).quaternion
        covariance = [self._noise**2 if index % 4 == 0 else 0.0 for index in range(9)]
        self._topic.publish(
            {
                "header": {"stamp": snapshot.time_ns, "frame_id": self._frame},
                "orientation": {"x": qx, "y": qy, "z": qz, "w": qw},
                "orientation_covariance": covariance,
                "angular_velocity": self._with_noise(motion.rate),
                "angular_velocity_covariance": covariance,
                "linear_acceleration": self._with_noise(motion.acceleration),
                "linear_acceleration_covariance": covariance,
            }
        )

    def _with_noise(self, vector: Vector3) -> dict[str, float]:
        errors = self._random.normal(0.0, self._noise, 3).tolist() if self._noise > 0.0 else ZERO
        return {axis: value + error for axis, value, error in zip("xyz", vector, errors, strict=True)}


def _calibrated(_request: "std_srvs.EmptyRequest") -> dict[str, object]:
    """Answer the calibration service; the simulated sensor needs no calibration."""
    return {}
