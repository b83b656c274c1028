"""Messages of sensors become measurements in the filter's frames."""

import math
from typing import Any

import numpy as np
import pytest
from tests.gazebo.nodes.fakes import MESSAGES

from trundle.gazebo.nodes.robot_localization.kalman import Measurement
from trundle.gazebo.nodes.robot_localization.sources import MessageReader, Source, read_sources
from trundle.robots.parameters import ParamError, RosParameters
from trundle.spatial import IDENTITY_QUATERNION, Pose, quaternion_from_rpy

POSES = {
    ("odom", "map"): Pose.from_rpy(1.0, 2.0, 0.0, yaw=math.pi / 2),
    ("base_link", "imu"): Pose.from_rpy(0.5, 0.0, 0.2, yaw=math.pi / 2),
    ("base_link", "wheel"): Pose.from_rpy(0.0, 1.0, 0.0),
}
ALL = [True] * 15


def reader(*, two_d: bool = False) -> MessageReader:
    def find(target: str, source: str, _: int) -> Pose | None:
        return Pose() if target == source else POSES.get((target, source))

    return MessageReader(world="odom", base="base_link", two_d=two_d, gravity=9.8, find=find)


def source(kind: str, used: list[int] | None = None, **more: Any) -> Source:
    mask = ALL if used is None else [index in used for index in range(15)]
    settings = {
        f"{kind}0": "topic",
        f"{kind}0_config": mask,
        **{f"{kind}0_{name}": value for name, value in more.items()},
    }
    (sensor,) = read_sources(RosParameters(settings, "/ekf"))
    return sensor


def read(sensor: Source, message: Any, *, two_d: bool = False) -> list[Measurement]:
    return reader(two_d=two_d).read(sensor, message, IDENTITY_QUATERNION)


def quaternion(yaw: float) -> dict[str, float]:
    w, x, y, z = quaternion_from_rpy(0.0, 0.0, yaw)
    return {"w": w, "x": x, "y": y, "z": z}


def odometry(
    x: float = 0.0, y: float = 0.0, yaw: float = 0.0, *, at: float = 1.0, frame: str = "odom", **more: Any
) -> Any:
    covariance = np.diag([0.1, 0.2, 0.3, 0.4, 0.5, 0.6]).ravel().tolist()
    pose = {"pose": {"position": {"x": x, "y": y}, "orientation": quaternion(yaw)}, "covariance": covariance}
    header = {"stamp": round(at * 1e9), "frame_id": frame}
    return MESSAGES.new("nav_msgs/Odometry", {"header": header, "child_frame_id": "base_link", "pose": pose, **more})


def test_a_pose_is_transformed_into_the_world_with_its_covariance() -> None:
    (pose,) = read(source("odom", [0, 1, 5]), odometry(3.0, 0.0, 0.2, frame="map"))
    assert pose.indices == (0, 1, 5)
    assert pose.values == pytest.approx((1.0, 5.0, 0.2 + math.pi / 2))
    assert np.diagonal(pose.covariance) == pytest.approx((0.2, 0.1, 0.6))
    assert pose.stamp_ns == 1_000_000_000


def test_a_used_axis_is_rotated_into_the_world() -> None:
    (pose,) = read(source("odom", [0]), odometry(3.0, frame="map"))
    assert pose.indices == (1,)


def test_differential_poses_are_a_body_twist() -> None:
    sensor = source("odom", [0, 1, 5], differential=True)
    assert read(sensor, odometry(1.0, 1.0, math.pi / 2, at=1.0)) == []
    (twist,) = read(sensor, odometry(1.0, 1.5, math.pi / 2 + 0.1, at=1.5))
    assert twist.indices == (6, 7, 11)
    assert twist.values == pytest.approx((1.0, 0.0, 0.2))
    assert twist.covariance[0, 0] == pytest.approx(0.1)


def test_relative_poses_start_at_zero() -> None:
    sensor = source("odom", [0, 1, 5], relative=True)
    (first,) = read(sensor, odometry(4.0, 2.0, math.pi / 2))
    (second,) = read(sensor, odometry(4.0, 3.0, math.pi / 2))
    assert first.values == pytest.approx((0.0, 0.0, 0.0))
    assert second.values == pytest.approx((1.0, 0.0, 0.0), abs=1e-12)


def test_a_sensor_off_the_centre_measures_the_lever_arm_velocity() -> None:
    """A wheel 1 m to the left of a base that turns at 0.5 rad/s moves backwards at 0.5 m/s."""
    twist = {"twist": {"linear": {"x": -0.5}, "angular": {"z": 0.5}}}
    message = MESSAGES.new(
        "geometry_msgs/TwistWithCovarianceStamped", {"header": {"frame_id": "wheel"}, "twist": twist}
    )
    (measurement,) = read(source("twist", [6, 7, 11]), message)
    assert measurement.values == pytest.approx((0.0, 0.0, 0.5))


def imu(*, yaw: float = 0.0, acceleration: tuple[float, float, float] = (0.0, 0.0, 0.0), **more: Any) -> Any:
    fields = {
        "header": {"frame_id": "imu"},
        "orientation": quaternion(yaw),
        "angular_velocity": {"x": 0.3, "z": 0.7},
        "linear_acceleration": dict(zip("xyz", acceleration, strict=True)),
    }
    return MESSAGES.new("sensor_msgs/Imu", {**fields, **more})


def test_an_imu_mounting_is_compensated() -> None:
    """Its x points to the robot's left."""
    angles, rates, acceleration = read(
        source("imu", [5, 9, 10, 11, 12, 13]), imu(yaw=2.0, acceleration=(1.0, 0.0, 9.8))
    )
    assert (angles.indices, angles.values) == ((5,), pytest.approx([2.0 - math.pi / 2]))
    assert (rates.indices, rates.values) == ((9, 10, 11), pytest.approx([0.0, 0.3, 0.7]))
    assert (acceleration.indices, acceleration.values) == ((12, 13), pytest.approx([0.0, 1.0]))


def test_gravity_is_removed_from_a_tilted_imu() -> None:
    lean = 0.2
    w, x, y, z = quaternion_from_rpy(0.0, lean, 0.0)
    measured = (-9.8 * math.sin(lean), 0.0, 9.8 * math.cos(lean))
    message = imu(orientation={"w": w, "x": x, "y": y, "z": z}, acceleration=measured)
    message.header.frame_id = "base_link"
    (measurement,) = read(source("imu", [12, 13, 14], remove_gravitational_acceleration=True), message)
    assert measurement.values == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)


def test_absent_imu_fields_are_ignored() -> None:
    absent = [-1.0, *[0.0] * 8]
    message = imu(orientation_covariance=absent, linear_acceleration_covariance=absent)
    (rates,) = read(source("imu"), message)
    assert rates.indices == (6, 7, 8, 9, 10, 11)
    assert read(source("imu", [3, 4, 5]), imu(orientation={"w": 0.0, "x": 0.0, "y": 0.0, "z": 0.0})) == []


def test_in_two_dimensions_height_roll_and_pitch_are_zero() -> None:
    (pose,) = read(source("odom", [0, 1, 5]), odometry(1.0), two_d=True)
    assert pose.indices == (0, 1, 2, 3, 4, 5)
    assert np.diagonal(pose.covariance)[2:5] == pytest.approx(1e-6)


def test_nans_and_unknown_frames_are_ignored() -> None:
    (pose,) = read(source("odom", [0, 1]), odometry(math.nan, 2.0))
    assert pose.indices == (1,)
    assert read(source("odom", [0, 1]), odometry(1.0, frame="nowhere")) == []


@pytest.mark.parametrize("config", [[True] * 14, "xyz", ["yes"] * 15])
def test_an_invalid_config_is_refused(config: object) -> None:
    with pytest.raises(ParamError, match="odom0_config"):
        read_sources(RosParameters({"odom0": "odom", "odom0_config": config}, "/ekf"))
