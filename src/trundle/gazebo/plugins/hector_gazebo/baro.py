"""libhector_gazebo_ros_baro.so: height of a link, and the air pressure there."""

from trundle.robots.parameters import TagParameters
from trundle.ros import Node, Publisher
from trundle.sim.simulation import ModelHandle, Simulation, Snapshot

from .error_model import ErrorModel
from .link_sensor import LinkSensor

_SCALE_M, _POWER = 44330.0, 5.263157
"""Scale and exponent of the barometric formula, from the original."""


class Baro(LinkSensor):
    """Publishes geometry_msgs/PointStamped (z alone) and hector_uav_msgs/Altimeter.

    Parameters: <bodyName> (the first link), <frameId> (the body), <topicName> pressure_height, <altimeterTopicName>
    altimeter, either of which may be empty, <updateRate> 0 (every step), <elevation> 0 [m] of the world's origin and
    <qnh> 1013.25 [hPa]; errors by <drift>, <gaussianNoise>, … [m].
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        super().__init__(sim, model, node, parameters)
        self._elevation = parameters.number("elevation", 0.0)
        self._qnh = parameters.number("qnh", 1013.25)
        self._errors = ErrorModel(parameters, self.random, axes=1)

        def advertise(name: str, default: str, kind: str) -> Publisher | None:
            topic = parameters.text(name, default)
            return node.advertise(self.topic(topic), kind, queue_size=10) if topic else None

        self._height = advertise("topicName", "pressure_height", "geometry_msgs/PointStamped")
        self._altimeter = advertise("altimeterTopicName", "altimeter", "hector_uav_msgs/Altimeter")

    def after_step(self, snapshot: Snapshot) -> None:
        """Publish height and pressure."""
        topics = [topic for topic in (self._height, self._altimeter) if topic is not None and topic.has_subscribers]
        if not topics:
            return
        (height,) = self._errors.apply(self.link.pose.position[2:], self.elapsed_s(snapshot.time_ns))
        header = {"stamp": snapshot.time_ns, "frame_id": self.frame}
        altitude = height + self._elevation
        pressure = max(1.0 - altitude / _SCALE_M, 0.0) ** _POWER * self._qnh
        for topic in topics:
            if topic is self._height:
                topic.publish({"header": header, "point": {"z": height}})
            else:
                topic.publish({"header": header, "altitude": altitude, "pressure": pressure, "qnh": self._qnh})

    def reset(self) -> None:
        """Restart the drift."""
        self._errors.reset()
