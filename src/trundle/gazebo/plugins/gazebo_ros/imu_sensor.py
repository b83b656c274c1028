"""libgazebo_ros_imu_sensor.so: readings of an imu sensor."""

from typing import Any

import numpy as np
from msgspec.structs import replace

from trundle.base.diagnostics import UsageError
from trundle.robots.parameters import TagParameters
from trundle.ros.bridge import imu_message
from trundle.sim.sensors import ImuReading, ImuSensor, InstrumentSensor
from trundle.spatial import Pose

from .namespaces import read_offset
from .plugin_names import PluginNames
from .sensor_publisher import SensorPublisher


def attach(sensor: InstrumentSensor, parameters: TagParameters, names: PluginNames) -> None:
    """Publish sensor_msgs/Imu.

    Parameters, with gazebo_ros' defaults: <topicName> imu_data, <frameName> (the link), <updateRateHZ> 1,
    <gaussianNoise> 0 (covariances are its square), <rpyOffset> 0 0 0 (or <rpyOffsets>; turns the orientation, in the
    axes of its reference) and <initialOrientationAsReference>: if false, as in REP 145 and by default from Noetic
    on, the reference is the world; if true, it is the sensor's, its first pose unless <imu> has another. As in the
    original, <xyzOffset> has no effect.
    """
    if not isinstance(sensor, ImuSensor):
        raise UsageError(f"sensor {sensor.name!r} is of type {sensor.sensor.type}; an imu is needed")
    topic = names.advertise("sensor_msgs/Imu", parameters.text("topicName", "imu_data"))
    rate_hz = parameters.number("updateRateHZ", 1.0)
    publisher = SensorPublisher(topic, names.frame(parameters.text("frameName", sensor.link.name)), rate_hz=rate_hz)
    noise = parameters.number("gaussianNoise", 0.0)
    random = np.random.default_rng(0)
    covariance = [noise**2 if index % 4 == 0 else 0.0 for index in range(9)]
    fields_with_noise = ("orientation", "angular_velocity", "linear_acceleration")
    covariances = {f"{name}_covariance": covariance for name in fields_with_noise}
    if not parameters.flag("initialOrientationAsReference", default=names.node.profile.imu_reference_is_first_pose):
        sensor.set_reference(Pose())
    offset = read_offset(parameters, ("rpyOffset",))
    parameters.ignore("bodyName", "serviceName", "xyzOffset", "xyzOffsets")

    def message(reading: ImuReading) -> dict[str, Any]:
        orientation = (offset @ Pose(quaternion=reading.orientation)).quaternion
        fields: dict[str, Any] = {**imu_message(replace(reading, orientation=orientation)), **covariances}
        if noise > 0.0:
            for name in fields_with_noise:
                fields[name] = {axis: value + float(random.normal(0.0, noise)) for axis, value in fields[name].items()}
        return fields

    def publish(reading: ImuReading) -> None:
        publisher.publish(reading, lambda: message(reading))

    sensor.listen(publish, enabled=publisher.has_subscribers)
