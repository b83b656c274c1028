"""Sensor plugins of hector_gazebo."""

from typing import Any

import pytest
from tests.gazebo_server import Gazebo, until

_INERTIA = "<inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia>"
_RAYS = """<ray><scan><horizontal><samples>5</samples><min_angle>-0.2</min_angle><max_angle>0.2</max_angle></horizontal>
<vertical><samples>3</samples><min_angle>-0.1</min_angle><max_angle>0.1</max_angle></vertical></scan>
<range><min>0.1</min><max>10</max></range></ray>"""
_CAMERA = """<camera><horizontal_fov>1.0</horizontal_fov><image><width>32</width><height>24</height></image>
<clip><near>0.1</near><far>20</far></clip></camera>"""
_WALL = """<sdf version="1.6"><model name="wall"><static>1</static><link name="l"><pose>2.5 0 1 0 0 0</pose>
<collision name="c"><geometry><box><size>1 10 1</size></box></geometry></collision>
<visual name="v"><geometry><box><size>1 10 1</size></box></geometry><material><ambient>0 0 0 1</ambient>
<diffuse>0 0 0 1</diffuse><emissive>1 0 0 1</emissive></material></visual></link></model></sdf>"""


def _first_message(gazebo: Gazebo, sensor: str, topic: str, kind: str) -> Any:
    """Return the first message of a sensor in front of a red wall at 2 m."""
    model = f"""<sdf version="1.6"><model name="mast"><link name="head"><pose>0 0 1 0 0 0</pose>
<inertial><mass>2</mass>{_INERTIA}</inertial>{sensor}</link>
<joint name="fix" type="fixed"><parent>world</parent><child>head</child></joint></model></sdf>"""
    assert gazebo.spawn(_WALL, "wall").success
    assert gazebo.spawn(model, "mast").success
    gazebo.call("unpause_physics")
    messages = gazebo.subscribe(topic, kind)
    until(lambda: messages)
    return messages[-1]


def test_a_sonar_publishes_the_nearest_range_with_its_errors(gazebo: Gazebo) -> None:
    plugin = """<plugin name="p" filename="libhector_gazebo_ros_sonar.so"><topicName>sonar_height</topicName>
<offset>0.25</offset></plugin>"""
    sensor = f'<sensor name="eye" type="ray"><update_rate>50</update_rate>{_RAYS}{plugin}</sensor>'
    message = _first_message(gazebo, sensor, "/sonar_height", "sensor_msgs/Range")

    assert message.range == pytest.approx(2.25, abs=1e-3)
    assert (message.radiation_type, message.header.frame_id) == (0, "sonar_link")
    assert message.field_of_view == pytest.approx(0.2)
    assert (message.min_range, message.max_range) == (pytest.approx(0.1), pytest.approx(10.0))


def test_a_thermal_camera_shows_red_as_hot(gazebo: Gazebo) -> None:
    plugin = """<plugin name="p" filename="libgazebo_ros_thermal_camera.so"><cameraName>thermal</cameraName>
<frameName>eye_link</frameName></plugin>"""
    sensor = f'<sensor name="eye" type="camera"><update_rate>20</update_rate>{_CAMERA}{plugin}</sensor>'
    message = _first_message(gazebo, sensor, "/thermal/image_raw", "sensor_msgs/Image")

    assert (message.width, message.height, message.step, message.encoding) == (32, 24, 32, "mono8")
    assert message.header.frame_id == "eye_link"
    assert message.data[12 * 32 + 16] == 255
    assert message.data[16] <= 3 * 255 // 8, "dark above the wall"
