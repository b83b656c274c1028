"""The filters of imus as nodes of a graph."""

import math
from typing import Any

import pytest

from trundle.ros import TransformListener
from trundle.spatial import conjugate, quaternion_from_rpy, rotate, rpy_from_quaternion


def imu(
    stamp_ns: int, *, turn: float = 0.0, pitch: float = 0.0, yaw: float = 0.0
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Messages of an imu and its magnetometer, in a world with y north."""
    header = {"stamp": stamp_ns, "frame_id": "imu_link"}
    inverse = conjugate(quaternion_from_rpy(0.0, pitch, yaw))
    acceleration = dict(zip("xyz", rotate(inverse, (0.0, 0.0, 9.80665)), strict=True))
    field = dict(zip("xyz", rotate(inverse, (0.0, 2e-5, -4e-5)), strict=True))
    raw = {"header": header, "angular_velocity": {"z": turn}, "linear_acceleration": acceleration}
    return raw, {"header": header, "magnetic_field": field}


def angles(message: Any) -> tuple[float, float, float]:
    q = message.orientation
    return rpy_from_quaternion((q.w, q.x, q.y, q.z))


def test_madgwick_pairs_imu_and_magnetometer_and_publishes_the_transform(graph: Any) -> None:
    filtered = graph.listen("/imu/data", "sensor_msgs/Imu")
    buffer = TransformListener(graph.client).buffer
    graph.start(
        "imu_filter_madgwick/imu_filter_node", remove_gravity_vector=True, orientation_stddev=0.1, yaw_offset=0.5
    )
    imus = graph.advertise("/imu/data_raw", "sensor_msgs/Imu")
    fields = graph.advertise("/imu/mag", "sensor_msgs/MagneticField")
    graph.until(lambda: graph.linked("/imu/data"))
    for step in range(1, 4):
        raw, field = imu(step * 10_000_000, pitch=0.3, yaw=-1.0)
        imus.publish(raw)
        fields.publish(field)

    graph.until(lambda: len(filtered) == 3)
    assert angles(filtered[-1]) == pytest.approx((0.0, 0.3, -0.5), abs=1e-3)
    acceleration = filtered[-1].linear_acceleration
    assert (acceleration.x, acceleration.y, acceleration.z) == pytest.approx((0.0, 0.0, 0.0), abs=0.02)
    assert list(filtered[-1].orientation_covariance) == pytest.approx([0.01, 0, 0, 0, 0.01, 0, 0, 0, 0.01])
    graph.until(lambda: buffer.can_transform("odom", "imu_link"))
    assert rpy_from_quaternion(buffer.lookup_transform("odom", "imu_link").rotation)[2] == pytest.approx(-0.5, abs=1e-3)


def test_the_complementary_filter_integrates(graph: Any) -> None:
    filtered = graph.listen("/imu/data", "sensor_msgs/Imu")
    states = graph.listen("/imu/steady_state", "std_msgs/Bool")
    program = "imu_complementary_filter/complementary_filter_node"
    graph.start(program, publish_debug_topics=True, constant_dt=0.1, reverse_tf=True, publish_tf=True)
    buffer = TransformListener(graph.client).buffer
    imus = graph.advertise("/imu/data_raw", "sensor_msgs/Imu")
    graph.until(lambda: graph.linked("/imu/data") and graph.linked("/imu/steady_state"))
    bad, _ = imu(1)
    imus.publish({**bad, "angular_velocity": {"z": math.nan}})
    for step in range(6):
        imus.publish(imu(10_000_000 * (step + 1), turn=0.4)[0])
        graph.until(lambda count=step + 1: len(filtered) == count)

    assert states
    assert angles(filtered[-1])[2] == pytest.approx(5 * 0.04, abs=0.01)
    graph.until(lambda: buffer.can_transform("imu_link", "odom"))
    transform = buffer.lookup_transform("imu_link", "odom")
    assert rpy_from_quaternion(transform.rotation)[2] == pytest.approx(-angles(filtered[-1])[2], abs=0.05)


def test_an_unknown_world_frame_is_a_sentence(graph: Any) -> None:
    log = graph.listen("/rosout", "rosgraph_msgs/Log")
    assert graph.start("imu_filter_madgwick/imu_filter_node", world_frame="mars").result(60.0) == 1
    graph.until(lambda: any("world_frame is 'mars'; it is enu, ned or nwu" in str(line.msg) for line in log))
