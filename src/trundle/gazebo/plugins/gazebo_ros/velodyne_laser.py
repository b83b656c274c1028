"""libgazebo_ros_velodyne_laser.so and libgazebo_ros_velodyne_gpu_laser.so: a Velodyne's point cloud."""

import math

import numpy as np

from trundle.robots.parameters import TagParameters
from trundle.sim.sensors import InstrumentSensor, RangeReading, directions_of

from .laser import require_rays
from .plugin_names import PluginNames
from .sensor_publisher import SensorPublisher

_POINT = np.dtype([(name, "<f4") for name in ("x", "y", "z", "intensity")] + [("ring", "<u2"), ("time", "<f4")])
_DATATYPES = {"<f4": 7, "<u2": 4}
"""sensor_msgs/PointField.FLOAT32 and UINT16."""
_FIELDS = [
    {"name": name, "offset": offset, "datatype": _DATATYPES[kind.str], "count": 1}
    for name, (kind, offset, *_) in (_POINT.fields or {}).items()
]


def attach(sensor: InstrumentSensor, parameters: TagParameters, names: PluginNames) -> None:
    """Publish sensor_msgs/PointCloud2 with intensity, ring and time, column by column from the lowest ray.

    Parameters, with velodyne_gazebo_plugins' defaults: <topicName> /points, <frameName> /world, <min_range> 0 and
    <max_range> (none) [m] within the sensor's own, <min_intensity> (none), <gaussianNoise> 0 (of ranges [m]),
    <organize_cloud> false (true: rays out of range are NaN points).
    """
    rays = require_rays(sensor)
    topic = names.advertise("sensor_msgs/PointCloud2", parameters.text("topicName", "/points"))
    publisher = SensorPublisher(topic, names.frame(parameters.text("frameName", "/world")))
    min_range = max(parameters.number("min_range", 0.0), rays.scan.min_m)
    max_range = min(parameters.number("max_range", rays.scan.max_m), rays.scan.max_m)
    min_intensity = parameters.number("min_intensity", 0.0) if "min_intensity" in parameters else -math.inf
    noise, random = parameters.number("gaussianNoise", 0.0), np.random.default_rng(0)
    organized = parameters.flag("organize_cloud", default=False)
    parameters.ignore("hokuyoMinIntensity", "updateRate")

    def message(reading: RangeReading) -> dict[str, object]:
        rows, columns = reading.ranges.shape
        ranges, intensities = reading.ranges.T.reshape(-1), reading.intensities.T.reshape(-1)
        directions = directions_of(reading.scan).reshape(rows, columns, 3).swapaxes(0, 1).reshape(-1, 3)
        is_hit = (ranges > min_range) & (ranges < max_range) & (intensities >= min_intensity)
        if noise > 0.0:
            ranges = ranges + random.normal(0.0, noise, len(ranges))
            is_hit &= (ranges > min_range) & (ranges < max_range)
        points = np.zeros(len(ranges), dtype=_POINT)
        points["ring"] = np.tile(np.arange(rows, dtype=np.uint16), columns)
        positions = np.where(is_hit[:, None], directions * np.where(is_hit, ranges, 0.0)[:, None], np.nan)
        points["x"], points["y"], points["z"] = positions.T
        points["intensity"] = np.where(is_hit, intensities, np.nan)
        points = points if organized else points[is_hit]
        width = rows if organized else len(points)
        return {
            "height": columns if organized else 1,
            "width": width,
            "fields": _FIELDS,
            "point_step": _POINT.itemsize,
            "row_step": _POINT.itemsize * width,
            "data": np.frombuffer(points.tobytes(), dtype=np.uint8),
            "is_dense": not organized,
        }

    rays.listen(lambda reading: publisher.publish(reading, lambda: message(reading)), enabled=publisher.has_subscribers)
