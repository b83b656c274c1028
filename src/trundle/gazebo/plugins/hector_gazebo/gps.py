"""libhector_gazebo_ros_gps.so: geodetic position of a link, and its velocity to the north and west."""

import math

from trundle.robots.model import SphericalCoordinates
from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.sensors import geodetic
from trundle.sim.simulation import ModelHandle, Simulation, Snapshot

from .error_model import ErrorModel
from .link_sensor import LinkSensor

_DIAGONAL_KNOWN = 2
"""sensor_msgs/NavSatFix.COVARIANCE_TYPE_DIAGONAL_KNOWN"""


_DARMSTADT = SphericalCoordinates(latitude_deg=49.9, longitude_deg=8.9, heading_deg=90.0)
"""Reference of the original, with the world's x axis to the north."""


class Gps(LinkSensor):
    """Publishes sensor_msgs/NavSatFix and geometry_msgs/Vector3Stamped (north, west, up).

    Parameters: <bodyName> (the first link), <frameId> /world, <topicName> fix, <velocityTopicName> fix_velocity,
    <updateRate> 4, <referenceLatitude> 49.9, <referenceLongitude> 8.9, <referenceAltitude> 0 and <referenceHeading> 0
    (of the world's x axis, clockwise from north [deg]), with <useWorldSphericalCoordinates> the world's; <status> 0,
    <service> 1; errors by <drift>, <gaussianNoise>, … [m] and <velocityDrift>, <velocityGaussianNoise>, … [m/s].
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        super().__init__(sim, model, node, parameters, frame="/world", rate_hz=4.0)
        is_worlds = parameters.flag("useWorldSphericalCoordinates", default=False)
        world = sim.world.spherical_coordinates if is_worlds else _DARMSTADT

        def reference(name: str, default: float) -> float:
            return parameters.number(f"reference{name}", default)

        heading_deg = reference("Heading", 90.0 - world.heading_deg)
        self._heading_rad = math.radians(heading_deg)
        self._origin = SphericalCoordinates(
            latitude_deg=reference("Latitude", world.latitude_deg),
            longitude_deg=reference("Longitude", world.longitude_deg),
            elevation=reference("Altitude", world.elevation),
            heading_deg=90.0 - heading_deg,
        )
        self._status = {
            "status": parameters.integer("status", 0),
            "service": parameters.integer("service", 1),
        }
        self._position_errors = ErrorModel(parameters, self.random)
        self._velocity_errors = ErrorModel(parameters, self.random, prefix="velocity")
        fix = parameters.text("topicName", "fix")
        velocity = parameters.text("velocityTopicName", "fix_velocity")
        self._fix = node.advertise(self.topic(fix), "sensor_msgs/NavSatFix", queue_size=10)
        self._velocity = node.advertise(self.topic(velocity), "geometry_msgs/Vector3Stamped", queue_size=10)

    def after_step(self, snapshot: Snapshot) -> None:
        """Publish position and velocity."""
        if not (self._fix.has_subscribers or self._velocity.has_subscribers):
            return
        dt_s = self.elapsed_s(snapshot.time_ns)
        header = {"stamp": snapshot.time_ns, "frame_id": self.frame}
        vx, vy, vz = self._velocity_errors.apply(self.link.twist.linear, dt_s)
        x, y, z = self._position_errors.apply(self.link.pose.position, dt_s)
        latitude, longitude, altitude = geodetic(self._origin, (x, y, z))
        east, north, up = self._position_errors.variances
        self._fix.publish(
            {
                "header": header,
                "status": self._status,
                "latitude": latitude,
                "longitude": longitude,
                "altitude": altitude,
                "position_covariance": [east, 0.0, 0.0, 0.0, north, 0.0, 0.0, 0.0, up],
                "position_covariance_type": _DIAGONAL_KNOWN,
            }
        )
        cos, sin = math.cos(self._heading_rad), math.sin(self._heading_rad)
        self._velocity.publish(
            {"header": header, "vector": {"x": cos * vx + sin * vy, "y": cos * vy - sin * vx, "z": vz}}
        )

    def reset(self) -> None:
        """Restart the drifts."""
        self._position_errors.reset()
        self._velocity_errors.reset()
