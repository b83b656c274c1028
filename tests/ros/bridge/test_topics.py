"""Topics of sensors."""

from typing import Any

import pytest

from trundle.base.diagnostics import Source
from trundle.robots.model import Model, Sensor
from trundle.ros.bridge.frame_names import sensor_topic

AT = Source("w.sdf", 1)


@pytest.mark.parametrize(
    ("topic", "output", "part", "expected"),
    [
        ("", "imu", "", "/m/base/s/imu"),
        ("__default__", "imu", "", "/m/base/s/imu"),
        ("__default_topic__", "imu", "", "/m/base/s/imu"),
        ("/", "imu", "", "/m/base/s/imu"),
        ("inertia", "imu", "", "/inertia"),
        ("/a/b", "imu", "", "/a/b"),
        ("~/a/2nd one", "imu", "", "/a/n_2nd_one"),
        ("/a/b", "camera_info", "", "/a/camera_info"),
        ("b", "camera_info", "", "/camera_info"),
        ("/a/b", "points", "", "/a/b/points"),
        ("/a", "imu", "left", "/a/left/imu"),
        ("/a", "camera_info", "left", "/a/left/camera_info"),
        ("", "camera_info", "left", "/m/base/s/left/camera_info"),
    ],
)
def test_the_topic_in_the_file_names_the_outputs(topic: str, output: str, part: str, expected: str) -> None:
    sensor = Sensor(name="s", type="imu", at=AT, topic=topic)
    assert sensor_topic(Model(name="m", at=AT), "base", sensor, output, main="imu", part=part) == expected


@pytest.mark.parametrize(
    ("type_", "message"),
    [
        ("imu", "sensor_msgs/Imu"),
        ("ray", "sensor_msgs/LaserScan"),
        ("gps", "sensor_msgs/NavSatFix"),
        ("contact", "gazebo_msgs/ContactsState"),
        ("air_pressure", "sensor_msgs/FluidPressure"),
        ("altimeter", "geometry_msgs/Vector3Stamped"),
        ("logical_camera", "tf2_msgs/TFMessage"),
        ("magnetometer", "sensor_msgs/MagneticField"),
        ("sonar", "sensor_msgs/Range"),
        ("rfid", "diagnostic_msgs/DiagnosticArray"),
    ],
)
def test_every_sensor_publishes_on_the_topic_in_the_file(receive: Any, type_: str, message: str) -> None:
    scan = "<ray><scan><horizontal><samples>3</samples></horizontal></scan><range><max>5</max></range></ray>"
    inside = "<topic>here/it_is</topic><update_rate>20</update_rate>" + (scan if type_ == "ray" else "")
    shape = '<collision name="c"><geometry><sphere><radius>1</radius></sphere></geometry></collision>'
    link = f'<link name="l">{shape}<sensor name="s" type="{type_}">{inside}</sensor></link>'
    received, _ = receive(f'<model name="m"><static>1</static>{link}</model>', {"/here/it_is": message})

    assert received.keys() == {"/here/it_is"}


@pytest.mark.parametrize(("type_", "message"), [("imu", "sensor_msgs/Imu"), ("contact", "gazebo_msgs/ContactsState")])
def test_imu_and_contact_settings_may_contain_the_topic(receive: Any, type_: str, message: str) -> None:
    shape = '<collision name="c"><geometry><sphere><radius>1</radius></sphere></geometry></collision>'
    sensor = f'<sensor name="s" type="{type_}"><{type_}><topic>/old</topic></{type_}></sensor>'
    received, _ = receive(
        f'<model name="m"><static>1</static><link name="l">{shape}{sensor}</link></model>', {"/old": message}
    )

    assert received.keys() == {"/old"}
