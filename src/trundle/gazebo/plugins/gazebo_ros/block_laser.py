"""libgazebo_ros_block_laser.so: the points of a ray sensor as sensor_msgs/PointCloud."""

import numpy as np

from trundle.robots.parameters import TagParameters
from trundle.sim.sensors import InstrumentSensor, RangeReading, directions_of

from .laser import advertise_scan, require_rays
from .plugin_names import PluginNames
from .sensor_publisher import SensorPublisher


def attach(sensor: InstrumentSensor, parameters: TagParameters, names: PluginNames) -> None:
    """Publish sensor_msgs/PointCloud: a point for each ray, at the largest range where nothing is hit, and intensities.

    Parameters, with gazebo_ros' defaults: <topicName> (without it points and, as in the original, /world), <frameName>
    /world, <gaussianNoise> 0 (of each coordinate of a hit [m], and of each intensity).
    """
    rays = require_rays(sensor)
    publisher = SensorPublisher(
        advertise_scan(names, parameters, "sensor_msgs/PointCloud", "points"),
        names.frame(parameters.text("frameName", "/world")),
    )
    noise, random = parameters.number("gaussianNoise", 0.0), np.random.default_rng(0)
    parameters.ignore("hokuyoMinIntensity", "updateRate")  # gazebo_ros reads neither of these

    def message(reading: RangeReading) -> dict[str, object]:
        ranges = np.nan_to_num(reading.ranges.reshape(-1), posinf=reading.scan.max_m, neginf=reading.scan.min_m)
        points = directions_of(reading.scan) * ranges[:, None]
        intensities = reading.intensities.reshape(-1).copy()
        if noise > 0.0:
            hit = np.isfinite(reading.ranges.reshape(-1))
            points[hit] += random.normal(0.0, noise, (np.count_nonzero(hit), 3))
            intensities += random.normal(0.0, noise, len(intensities))
        fields = [{"x": x, "y": y, "z": z} for x, y, z in points.tolist()]
        return {"points": fields, "channels": [{"values": intensities.astype(np.float32)}]}

    rays.listen(lambda reading: publisher.publish(reading, lambda: message(reading)), enabled=publisher.has_subscribers)
