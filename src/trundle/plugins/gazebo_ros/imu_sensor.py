"""libgazebo_ros_imu_sensor.so: readings of an imu sensor."""

from typing import Any

import numpy as np

from trundle.bridge import imu_message
from trundle.diagnostics import UsageError
from trundle.parameters import TagParameters
from trundle.ros import Node
from trundle.sensors import ImuReading, ImuSensor, InstrumentSensor

from .namespaces import read_namespace
from .sensor_publisher import SensorPublisher, read_frame_name, read_topic_name


def attach(sensor: InstrumentSensor, node: Node, parameters: TagParameters) -> None:
    """Publish sensor_msgs/Imu.

    Parameters, with gazebo_ros' defaults: <topicName> imu_data, <frameName> (the link), <updateRateHZ> 1,
    <gaussianNoise> 0; covariances are its square.
    """
    if not isinstance(sensor, ImuSensor):
        raise UsageError(f"sensor {sensor.name!r} is of type {sensor.sensor.type}; an imu is needed")
    topic = read_topic_name(parameters, read_namespace(parameters, sensor.model.name), "topicName", "imu_data")
    rate_hz = parameters.number("updateRateHZ", 1.0)
    frame = read_frame_name(parameters, sensor.link.name)
    outlet = SensorPublisher(node, topic, "sensor_msgs/Imu", frame, rate_hz=rate_hz)
    noise = parameters.number("gaussianNoise", 0.0)
    random = np.random.default_rng(0)
    covariance = [noise**2 if number % 4 == 0 else 0.0 for number in range(9)]
    names = ("orientation", "angular_velocity", "linear_acceleration")
    covariances = {f"{name}_covariance": covariance for name in names}
    parameters.warn_unsupported("xyzOffset", "rpyOffset", "initialOrientationAsReference")
    parameters.ignore("bodyName", "serviceName")

    def message(reading: ImuReading) -> dict[str, Any]:
        fields: dict[str, Any] = {**imu_message(reading), **covariances}
        if noise > 0.0:
            for name in names:
                fields[name] = {axis: value + float(random.normal(0.0, noise)) for axis, value in fields[name].items()}
        return fields

    def publish(reading: ImuReading) -> None:
        outlet.publish(reading, lambda: message(reading))

    sensor.listen(publish, enabled=outlet.has_subscribers)
