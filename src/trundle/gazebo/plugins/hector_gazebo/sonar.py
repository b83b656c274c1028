"""libhector_gazebo_ros_sonar.so: the nearest of a ray sensor's ranges, with hector's errors."""

import numpy as np

from trundle.base.diagnostics import UsageError
from trundle.robots.model import ScanAxis
from trundle.robots.parameters import TagParameters
from trundle.sim.sensors import InstrumentSensor, RangeReading, RangeSensor

from ..gazebo_ros.plugin_names import PluginNames
from ..gazebo_ros.sensor_publisher import SensorPublisher
from .error_model import ErrorModel


def attach(sensor: InstrumentSensor, parameters: TagParameters, names: PluginNames) -> None:
    """Publish sensor_msgs/Range.

    Parameters: <topicName> sonar, <frameId> /sonar_link, <updateRate> 10; errors by <drift>, <gaussianNoise>, … [m].
    The field of view is the narrower of the sensor's two.
    """
    if not isinstance(sensor, RangeSensor):
        raise UsageError(f"sensor {sensor.name!r} is of type {sensor.sensor.type}; a ray sensor is needed")
    topic = names.advertise("sensor_msgs/Range", parameters.text("topicName", "sonar"))
    frame, rate_hz = names.frame(parameters.text("frameId", "/sonar_link")), parameters.number("updateRate", 10.0)
    publisher = SensorPublisher(topic, frame, rate_hz=rate_hz)
    errors = ErrorModel(parameters, np.random.default_rng(0), axes=1)
    last_ns = 0

    def message(reading: RangeReading) -> dict[str, object]:
        nonlocal last_ns
        elapsed_s, last_ns = max(reading.time_ns - last_ns, 0) / 1e9, reading.time_ns
        min_range, max_range = reading.scan.min_m, reading.scan.max_m
        nearest = min(float(np.nanmin(reading.ranges)), max_range) if reading.ranges.size else max_range
        if nearest < max_range:
            nearest = min(max(errors.apply((nearest,), elapsed_s)[0], min_range), max_range)
        return {
            "radiation_type": 0,
            "field_of_view": min(_width(reading.scan.horizontal), _width(reading.scan.vertical)),
            "min_range": min_range,
            "max_range": max_range,
            "range": nearest,
        }

    def publish(reading: RangeReading) -> None:
        publisher.publish(reading, lambda: message(reading))

    sensor.listen(publish, enabled=publisher.has_subscribers)


def _width(axis: ScanAxis) -> float:
    return abs(axis.max_angle - axis.min_angle)
