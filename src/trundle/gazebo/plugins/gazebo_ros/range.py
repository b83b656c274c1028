"""libgazebo_ros_range.so: the nearest of a ray sensor's ranges, as of a sonar or infrared sensor."""

import numpy as np

from trundle.base.diagnostics import UsageError
from trundle.robots.parameters import TagParameters
from trundle.sim.sensors import InstrumentSensor, RangeReading, RangeSensor

from .plugin_names import PluginNames
from .sensor_publisher import SensorPublisher

_KINDS = {"ultrasound": 0, "infrared": 1}


def attach(sensor: InstrumentSensor, parameters: TagParameters, names: PluginNames) -> None:
    """Publish sensor_msgs/Range.

    Parameters, with gazebo_ros' defaults: <topicName> /range, <frameName> /world, <radiation> ultrasound or infrared,
    <fov> 0.05 [rad], <gaussianNoise> 0 [m], <updateRate> 0 (the sensor's).
    """
    if not isinstance(sensor, RangeSensor):
        raise UsageError(f"sensor {sensor.name!r} is of type {sensor.sensor.type}; a ray sensor is needed")
    topic = names.advertise("sensor_msgs/Range", parameters.text("topicName", "/range"))
    frame, rate_hz = names.frame(parameters.text("frameName", "/world")), parameters.number("updateRate", 0.0)
    publisher = SensorPublisher(topic, frame, rate_hz=rate_hz)
    radiation = parameters.text("radiation", "ultrasound")
    if radiation not in _KINDS:
        parameters.warn(f"radiation {radiation!r} is neither of {', '.join(_KINDS)}; ultrasound is used")
    fov = parameters.number("fov", 0.05)
    noise = parameters.number("gaussianNoise", 0.0)
    random = np.random.default_rng(0)

    def message(reading: RangeReading) -> dict[str, object]:
        min_range, max_range = reading.scan.min_m, reading.scan.max_m
        nearest = min(float(np.nanmin(reading.ranges)), max_range) if reading.ranges.size else max_range
        if noise > 0.0 and nearest < max_range:
            nearest = min(max(nearest + float(random.normal(0.0, noise)), min_range), max_range)
        return {
            "radiation_type": _KINDS.get(radiation, 0),
            "field_of_view": fov,
            "min_range": min_range,
            "max_range": max_range,
            "range": max(nearest, min_range),
        }

    def publish(reading: RangeReading) -> None:
        publisher.publish(reading, lambda: message(reading))

    sensor.listen(publish, enabled=publisher.has_subscribers)
