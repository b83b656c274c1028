"""navsat_transform_node: its services, and its way from our GPS through the EKF."""

import math
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from trundle.gazebo.nodes.robot_localization.geodesy import to_utm, zone_of
from trundle.ros import Messages, RosError, TransformListener, open_bag, to_nsec
from trundle.spatial import quaternion_from_rpy

LATITUDE, LONGITUDE = 48.1, 11.6
WORLD = """
<sdf version="1.6"><world name="default">
  <spherical_coordinates><latitude_deg>48.1</latitude_deg><longitude_deg>11.6</longitude_deg><elevation>520</elevation>
    <heading_deg>0</heading_deg></spherical_coordinates>
  <include><uri>model://ground_plane</uri></include>
  <model name="robot"><pose>3 2 0.1 0 0 0.5</pose>
    <link name="base_link"><inertial><mass>5</mass></inertial>
      <collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry><surface><friction><ode><mu>0</mu>
        <mu2>0</mu2></ode></friction></surface></collision></link>
    <plugin name="drive" filename="libgazebo_ros_planar_move.so"><robotBaseFrame>base_link</robotBaseFrame></plugin>
    <plugin name="gps" filename="libhector_gazebo_ros_gps.so"><topicName>gps/fix</topicName><frameId>base_link</frameId>
      <updateRate>5</updateRate><useWorldSphericalCoordinates>true</useWorldSphericalCoordinates>
      <gaussianNoise>0.01 0.01 0.01</gaussianNoise></plugin>
    <plugin name="imu" filename="libhector_gazebo_ros_imu.so"><topicName>imu/data</topicName><updateRate>30</updateRate>
      <bodyName>base_link</bodyName><frameId>base_link</frameId></plugin>
    <plugin name="truth" filename="libgazebo_ros_p3d.so"><bodyName>base_link</bodyName><topicName>truth</topicName>
      <frameName>world</frameName><updateRate>10</updateRate></plugin>
  </model>
</world></sdf>
"""
LAUNCH = """
<launch>
  <param name="use_sim_time" value="true"/>
  <node pkg="gazebo_ros" type="gzserver" name="gazebo" args="{world}"/>
  <node pkg="robot_localization" type="navsat_transform_node" name="navsat">
    <param name="publish_filtered_gps" value="true"/>
  </node>
  <node pkg="robot_localization" type="ekf_localization_node" name="ekf">
    <rosparam>
      two_d_mode: true
      publish_tf: false
      odom0: odom
      odom0_config: [0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0]
      odom1: odometry/gps
      odom1_config: [1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]
      imu0: imu/data
      imu0_config: [0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0]
    </rosparam>
  </node>
  <node pkg="rostopic" type="rostopic" name="drive" args="pub /cmd_vel geometry_msgs/Twist
    '{{linear: {{x: 0.5}}, angular: {{z: 0.1}}}}'"/>
</launch>
"""


def read(bag: Path, topic: str) -> list[Any]:
    messages = Messages()
    with open_bag(bag) as opened:
        return [
            messages.deserialize(message.data, message.connection.type)
            for message in opened.messages(lambda connection: connection.topic == topic)
        ]


def places(messages: list[Any]) -> np.ndarray:
    """Stamp [s], x and y [m] of each message."""
    rows = [[to_nsec(m.header.stamp) / 1e9, m.pose.pose.position.x, m.pose.pose.position.y] for m in messages]
    return np.array(rows)


@pytest.mark.slow
def test_fixes_of_our_gps_keep_the_filter_on_the_robot_s_way(tmp_path: Path) -> None:
    """The odometry's frame begins at the robot, and its x axis looks east, as the world's."""
    world, launch, bag = tmp_path / "field.world", tmp_path / "field.launch", tmp_path / "field.bag"
    world.write_text(WORLD)
    launch.write_text(LAUNCH.format(world=world))
    command = [sys.executable, "-m", "trundle", "launch", "--port", "0", str(launch), "--headless", "--speed", "max"]
    subprocess.run([*command, "--duration", "30", "--record", str(bag)], check=True, timeout=600)

    truth, gps, filtered = (places(read(bag, topic)) for topic in ("/truth", "/odometry/gps", "/odometry/filtered"))
    assert np.hypot(*(truth[-1, 1:] - truth[0, 1:])) > 3.0
    assert len(gps) > 50
    for found, error_m in ((gps, 0.05), (filtered[filtered[:, 0] > 5.0], 0.05)):
        x = np.interp(found[:, 0], truth[:, 0], truth[:, 1]) - 3.0
        y = np.interp(found[:, 0], truth[:, 0], truth[:, 2]) - 2.0
        assert np.median(np.hypot(found[:, 1] - x, found[:, 2] - y)) < error_m
    fix, raw = read(bag, "/gps/filtered")[-1], read(bag, "/gps/fix")[-1]
    assert fix.latitude == pytest.approx(raw.latitude, abs=2e-6)
    assert fix.longitude == pytest.approx(raw.longitude, abs=2e-6)


def odometry(graph: Any, x: float = 0.0) -> dict[str, Any]:
    header = {"stamp": graph.client.clock.now_ns(), "frame_id": "odom"}
    pose = {"pose": {"position": {"x": x}, "orientation": {"w": 1.0}}}
    return {"header": header, "child_frame_id": "base_link", "pose": pose}


def test_a_datum_is_the_origin_and_places_are_converted_both_ways(graph) -> None:
    """Its heading is the odometry's x axis: north here."""
    buffer = TransformListener(graph.client).buffer
    graph.start(
        "robot_localization/navsat_transform_node",
        wait_for_datum=True,
        datum=[LATITUDE, LONGITUDE, math.pi / 2.0],
        broadcast_utm_transform=True,
        frequency=50.0,
    )
    graph.until(lambda: buffer.can_transform("odom", "utm"))
    point = {"latitude": LATITUDE + 1e-4, "longitude": LONGITUDE}

    ahead = graph.call("/fromLL", "robot_localization/FromLL", ll_point=point).map_point
    back = graph.call("/toLL", "robot_localization/ToLL", map_point={"x": ahead.x, "y": ahead.y}).ll_point

    assert (ahead.x, ahead.y) == (pytest.approx(11.12, abs=0.01), pytest.approx(0.0, abs=0.01))
    assert (back.latitude, back.longitude) == pytest.approx((LATITUDE + 1e-4, LONGITUDE), abs=1e-9)
    place = to_utm(LATITUDE, LONGITUDE, zone_of(LATITUDE, LONGITUDE))
    utm_from_odom = buffer.lookup_transform("utm", "odom").pose
    assert utm_from_odom.position[:2] == pytest.approx((place.easting_m, place.northing_m), abs=1e-3)

    w, x, y, z = quaternion_from_rpy(0.0, 0.0, 0.0)
    pose = {"position": point, "orientation": {"w": w, "x": x, "y": y, "z": z}}
    graph.call("/datum", "robot_localization/SetDatum", geo_pose=pose)
    graph.until(lambda: abs(graph.call("/toLL", "robot_localization/ToLL").ll_point.latitude - LATITUDE - 1e-4) < 1e-9)


def test_fixes_become_odometry_in_a_tangent_plane(graph) -> None:
    """The imu's heading is 90°: the robot, at x = 2 m in its odometry, looks north along its x axis."""
    found = graph.listen("/odometry/gps", "nav_msgs/Odometry")
    graph.start(
        "robot_localization/navsat_transform_node", use_local_cartesian=True, zero_altitude=True, frequency=50.0
    )
    odom = graph.advertise("/odometry/filtered", "nav_msgs/Odometry")
    imu, fix = graph.advertise("/imu/data", "sensor_msgs/Imu"), graph.advertise("/gps/fix", "sensor_msgs/NavSatFix")
    step = 0.0

    def is_there() -> bool:
        nonlocal step
        odom.publish(odometry(graph, 2.0))
        imu.publish({"header": {"frame_id": "base_link"}, "orientation": {"w": math.sqrt(0.5), "z": math.sqrt(0.5)}})
        covariance = [1.0, 0.0, 0.0, 0.0, 4.0, 0.0, 0.0, 0.0, 9.0]
        place = {"latitude": LATITUDE + step, "longitude": LONGITUDE, "altitude": 500.0}
        fix.publish({"header": {"frame_id": "base_link"}, **place, "position_covariance": covariance})
        if found:
            step = 1e-5
        return bool(found) and found[-1].pose.pose.position.x > 3.0

    graph.until(is_there)
    last = found[-1]
    assert last.header.frame_id == "odom"
    assert last.pose.pose.position.x == pytest.approx(2.0 + 1.112, abs=0.01)
    assert last.pose.pose.position.y == pytest.approx(0.0, abs=0.01)
    assert last.pose.pose.position.z == 0.0
    assert (last.pose.covariance[0], last.pose.covariance[7]) == (pytest.approx(4.0), pytest.approx(1.0))


def test_what_is_asked_too_early_or_wrongly_is_refused(graph) -> None:
    logs = graph.listen("/rosout", "rosgraph_msgs/Log")
    found = graph.listen("/odometry/gps", "nav_msgs/Odometry")
    graph.start("robot_localization/navsat_transform_node", frequency=50.0)
    fix = graph.advertise("/gps/fix", "sensor_msgs/NavSatFix")

    with pytest.raises(RosError):
        graph.call("/toLL", "robot_localization/ToLL")
    with pytest.raises(RosError):
        graph.call("/setUTMZone", "robot_localization/SetUTMZone", utm_zone="99X")
    with pytest.raises(RosError):
        graph.call("/datum", "robot_localization/SetDatum", geo_pose={"position": {"latitude": math.nan}})

    def is_told() -> bool:
        fix.publish({"latitude": math.nan})
        fix.publish({"latitude": 89.0})
        return any("a fix is left out" in log.msg for log in logs)

    graph.until(is_told)
    assert not found
    graph.call("/setUTMZone", "robot_localization/SetUTMZone", utm_zone="32U")
