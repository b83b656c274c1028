"""libgazebo_ros_thermal_camera.so of hector_gazebo: pure red is hot, other colors are dark."""

import numpy as np

from trundle.robots.parameters import TagParameters
from trundle.sim.sensors import CameraReading, CameraSensor

from ..gazebo_ros.camera import attach_images
from ..gazebo_ros.plugin_names import PluginNames

_HOT = (255, 0, 0)
_DIVISOR = 8
"""Divisor of the sum of the three color channels."""


def attach(sensor: CameraSensor, parameters: TagParameters, names: PluginNames) -> None:
    """Publish sensor_msgs/Image in mono8, and camera_info; parameters are those of gazebo_ros' camera."""
    attach_images(sensor, parameters, names, _grey)


def _grey(reading: CameraReading) -> dict[str, object]:
    rgb = reading.rgb
    grey = (rgb.sum(axis=2, dtype=np.uint16) // _DIVISOR).astype(np.uint8)
    grey[(rgb == _HOT).all(axis=2)] = 255
    height, width = grey.shape
    return {"height": height, "width": width, "encoding": "mono8", "step": width, "data": grey.reshape(-1)}
