"""libhector_gazebo_ros_magnetic.so: Earth's magnetic field in a link's axes."""

import math

from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import ModelHandle, Simulation, Snapshot
from trundle.spatial import Pose

from .error_model import ErrorModel
from .link_sensor import LinkSensor


class Magnetic(LinkSensor):
    """Publishes geometry_msgs/Vector3Stamped, or sensor_msgs/MagneticField with <useMagneticFieldMsgs>.

    Parameters: <bodyName> (the first link), <frameId> (the body), <topicName> magnetic, <updateRate> 0 (every step),
    <magnitude> 1, <declination> 0, <inclination> 60 and <referenceHeading> 0 [deg] (of the world's x axis, clockwise
    from north; with <useWorldSphericalCoordinates> the world's); errors by <drift>, <gaussianNoise>, …
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        super().__init__(sim, model, node, parameters)

        def angle(name: str, default_deg: float) -> float:
            return math.radians(parameters.number(name, default_deg))

        strength = parameters.number("magnitude", 1.0)
        is_worlds = parameters.flag("useWorldSphericalCoordinates", default=False)
        heading = angle("referenceHeading", 90.0 - sim.world.spherical_coordinates.heading_deg if is_worlds else 0.0)
        azimuth, dip = heading - angle("declination", 0.0), angle("inclination", 60.0)
        horizontal = strength * math.cos(dip)
        self._field = (horizontal * math.cos(azimuth), horizontal * math.sin(azimuth), -strength * math.sin(dip))
        self._errors = ErrorModel(parameters, self.random)
        with_field = parameters.flag("useMagneticFieldMsgs", default=False)
        kind = "sensor_msgs/MagneticField" if with_field else "geometry_msgs/Vector3Stamped"
        self._field_name = "magnetic_field" if with_field else "vector"
        topic = parameters.text("topicName", "magnetic")
        self._topic = node.advertise(self.topic(topic), kind, queue_size=1)

    def after_step(self, snapshot: Snapshot) -> None:
        """Publish the field."""
        if not self._topic.has_subscribers:
            return
        field_in_link = Pose(quaternion=self.link.pose.quaternion).inverse().transform_vector(self._field)
        field = dict(zip("xyz", self._errors.apply(field_in_link, self.elapsed_s(snapshot.time_ns)), strict=True))
        header = {"stamp": snapshot.time_ns, "frame_id": self.frame}
        self._topic.publish({"header": header, self._field_name: field})

    def reset(self) -> None:
        """Restart the drift."""
        self._errors.reset()
