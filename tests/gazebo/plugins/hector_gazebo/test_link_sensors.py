"""Imus, gps, magnetometers and barometers as model plugins of gazebo_ros and hector_gazebo."""

import math
from typing import Any

import pytest
from tests.gazebo_server import Gazebo, until

_INERTIA = "<inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia>"


def _model_sdf(filename: str, parameters: str, *, pose: str = "0 0 2 0 0 0") -> str:
    return f"""<sdf version="1.6"><model name="box"><pose>{pose}</pose><link name="body">
<inertial><mass>2</mass>{_INERTIA}</inertial></link>
<plugin name="p" filename="lib{filename}.so">{parameters}</plugin>
<plugin name="push" filename="libgazebo_ros_force.so"><bodyName>body</bodyName><topicName>push</topicName></plugin>
</model></sdf>"""


def _push(gazebo: Gazebo, **force: float) -> None:
    """Apply a force plus the force that balances the weight."""
    gazebo.advertise("/push", "geometry_msgs/Wrench")({"force": {**force, "z": 2 * 9.8 + force.get("z", 0.0)}})
    gazebo.call("unpause_physics")


def _xyz(vector: Any) -> list[float]:
    return [vector.x, vector.y, vector.z]


@pytest.mark.parametrize(
    ("filename", "parameters", "topic", "up"),
    [
        (
            "gazebo_ros_imu",
            "<bodyName>body</bodyName><topicName>imu</topicName>",
            "/imu",
            0.0,
        ),
        ("hector_gazebo_ros_imu", "<topicName>imu/data</topicName>", "/imu/data", 9.8),
    ],
)
def test_an_imu_on_a_link_measures_acceleration_in_its_axes(
    gazebo: Gazebo, filename: str, parameters: str, topic: str, up: float
) -> None:
    """With a yaw of 90°, a force along the world's x is along −y; only hector's includes gravity."""
    parameters += "<updateRate>50</updateRate>"
    assert gazebo.spawn(_model_sdf(filename, parameters, pose=f"0 0 2 0 0 {math.pi / 2}"), "box").success
    messages = gazebo.subscribe(topic, "sensor_msgs/Imu")
    _push(gazebo, x=1.0)
    until(lambda: messages and messages[-1].linear_acceleration.y < -0.4)

    assert _xyz(messages[-1].linear_acceleration) == pytest.approx([0.0, -0.5, up], abs=1e-3)
    assert _xyz(messages[-1].angular_velocity) == pytest.approx([0.0, 0.0, 0.0], abs=1e-6)
    assert messages[-1].orientation.z == pytest.approx(math.sqrt(0.5), abs=1e-6)
    assert messages[-1].header.frame_id == "body"


def test_hectors_imu_has_the_errors_of_its_parameters(gazebo: Gazebo) -> None:
    parameters = """<accelOffset>1 2 3</accelOffset><rateGaussianNoise>0.5</rateGaussianNoise>
<rateDrift>0.1 0.1 0.1</rateDrift>
<headingOffset>0.3</headingOffset><updateRate>100</updateRate><frameId>imu_link</frameId>"""
    assert gazebo.spawn(_model_sdf("hector_gazebo_ros_imu", parameters), "box").success
    messages = gazebo.subscribe("/imu", "sensor_msgs/Imu")
    _push(gazebo)
    until(lambda: len(messages) > 100)

    accelerations = [_xyz(message.linear_acceleration) for message in messages[10:100]]
    assert accelerations[-1] == pytest.approx([1.0, 2.0, 12.8], abs=1e-3)
    rates = [message.angular_velocity.x for message in messages[10:100]]
    deviation = math.sqrt(sum(rate**2 for rate in rates) / len(rates))
    assert 0.3 < deviation < 0.8  # 90 draws of 0.5, on a drift of 0.1
    assert messages[-1].angular_velocity_covariance[0] == pytest.approx(0.25)
    assert 2 * math.asin(messages[-1].orientation.z) == pytest.approx(0.3)
    assert messages[-1].header.frame_id == "imu_link"


def test_hectors_gps_publishes_position_and_velocity(gazebo: Gazebo) -> None:
    """The world's x axis points south here; a degree of latitude is 111.23 km at 49.9° on WGS84."""
    parameters = """<topicName>fix</topicName><referenceHeading>180</referenceHeading><updateRate>50</updateRate>
<frameId>base_link</frameId><gaussianNoise>0 0 0</gaussianNoise>"""
    assert gazebo.spawn(_model_sdf("hector_gazebo_ros_gps", parameters, pose="100 0 2 0 0 0"), "box").success
    fixes = gazebo.subscribe("/fix", "sensor_msgs/NavSatFix")
    speeds = gazebo.subscribe("/fix_velocity", "geometry_msgs/Vector3Stamped")
    _push(gazebo, x=2.0)
    until(lambda: speeds and speeds[-1].vector.x < -0.2)

    assert fixes[0].latitude == pytest.approx(49.9 - 100 / 111_230, abs=2e-6)
    assert fixes[0].longitude == pytest.approx(8.9, abs=1e-7)
    assert fixes[0].altitude == pytest.approx(2.0, abs=0.01)
    assert abs(speeds[-1].vector.y) < 1e-6
    assert fixes[0].header.frame_id == "base_link"


@pytest.mark.parametrize("with_field", [False, True])
def test_hectors_magnetometer_measures_north_and_down(gazebo: Gazebo, with_field: bool) -> None:
    """The world's x axis points north, and the box, turned by 90°, faces west: north is on its right."""
    parameters = f"""<inclination>30</inclination><magnitude>2</magnitude>
<useMagneticFieldMsgs>{str(with_field).lower()}</useMagneticFieldMsgs><updateRate>50</updateRate>"""
    model = _model_sdf("hector_gazebo_ros_magnetic", parameters, pose=f"0 0 2 0 0 {math.pi / 2}")
    assert gazebo.spawn(model, "box").success
    kind = "sensor_msgs/MagneticField" if with_field else "geometry_msgs/Vector3Stamped"
    messages = gazebo.subscribe("/magnetic", kind)
    _push(gazebo)
    until(lambda: messages)

    field = messages[-1].magnetic_field if with_field else messages[-1].vector
    assert _xyz(field) == pytest.approx([0.0, -2 * math.cos(math.pi / 6), -1.0], abs=1e-6)


def test_hectors_barometer_measures_height_and_pressure(gazebo: Gazebo) -> None:
    """Near the sea level the pressure falls by about 12 Pa per metre."""
    parameters = "<elevation>100</elevation><qnh>1000</qnh><frameId>baro_link</frameId><offset>0.5</offset>"
    assert gazebo.spawn(_model_sdf("hector_gazebo_ros_baro", parameters), "box").success
    heights = gazebo.subscribe("/pressure_height", "geometry_msgs/PointStamped")
    messages = gazebo.subscribe("/altimeter", "hector_uav_msgs/Altimeter")
    _push(gazebo)
    until(lambda: messages and heights)

    assert heights[-1].point.z == pytest.approx(2.5, abs=1e-3)
    assert heights[-1].header.frame_id == "baro_link"
    assert messages[-1].altitude == pytest.approx(102.5, abs=1e-3)
    assert messages[-1].pressure == pytest.approx(1000 - 0.1188 * 102.5, abs=0.1)
    assert messages[-1].qnh == 1000.0
