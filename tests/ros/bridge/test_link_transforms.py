"""Link frames: names, parents and relative poses."""

import math

import numpy as np
import pytest
from hypothesis import given, strategies as st

from trundle.base.diagnostics import Source
from trundle.robots.model import Joint, JointAxis, JointType, Link, Model, Sensor, World
from trundle.robots.robot import Robot, RobotLink
from trundle.ros.bridge import FrameNames, link_frames
from trundle.ros.bridge.link_transforms import relative_poses
from trundle.spatial import Pose

AT = Source("test.sdf", 1)
angle = st.floats(-math.pi, math.pi)
length = st.floats(-10, 10)
poses = st.builds(Pose.from_rpy, length, length, length, angle, angle, angle)


def arm(name: str = "arm", **more: object) -> Model:
    hinge = Joint(
        name="hinge",
        type=JointType.REVOLUTE,
        parent="base",
        child="beam",
        at=AT,
        axis=JointAxis(direction=(0.0, 0.0, 1.0)),
    )
    links = (Link(name="beam", at=AT), Link(name="base", at=AT))
    return Model(name=name, at=AT, links=links, joints=(hinge,), **more)  # pyright: ignore[reportArgumentType]


def row(pose: Pose) -> list[float]:
    return [*pose.position, *pose.quaternion]


@given(poses, poses)
def test_a_relative_pose_times_its_parent_is_the_child(parent: Pose, child: Pose) -> None:
    (relative,) = relative_poses(np.array([row(parent), row(child)]), np.array([0]), np.array([1]))

    x, y, z, *q = relative.tolist()
    again = parent @ Pose((x, y, z), (q[0], q[1], q[2], q[3]))

    assert again.position == pytest.approx(child.position, abs=1e-9)
    assert again.quaternion == pytest.approx(child.quaternion, abs=1e-9)


def test_frames_of_a_single_robot_are_plain_link_names() -> None:
    world = World(name="w", at=AT, models=(arm(), Model(name="ground_plane", at=AT, static=True, added=True)))

    frames = link_frames(world)

    assert [(f.frame, f.parent) for f in frames] == [("beam", "base"), ("base", "world")]
    assert [(f.link, f.parent_link) for f in frames] == [(0, 1), (1, None)]


def test_frames_of_a_world_file_have_the_model_as_prefix() -> None:
    """Otherwise two equal robots would share the frame `base`."""
    world = World(name="w", at=AT, models=(arm("left arm"), arm("2nd")))

    names = [f.frame for f in link_frames(world)]

    assert len(set(names)) == 4
    assert names[0] == "left_arm/beam"


def test_fixed_links_are_marked_as_not_moving() -> None:
    rigid = Joint(
        name="rod",
        type=JointType.REVOLUTE,
        parent="base",
        child="beam",
        at=AT,
        axis=JointAxis(direction=(0.0, 0.0, 1.0), lower=0.0, upper=0.0),
    )
    model = Model(name="arm", at=AT, links=arm().links, joints=(rigid,))

    assert [f.is_moving for f in link_frames(World(name="w", at=AT, models=(model,)))] == [False, True]
    assert [f.is_moving for f in link_frames(World(name="w", at=AT, models=(arm(static=True),)))] == [False, False]


def sensor(name: str) -> Sensor:
    return Sensor(name=name, type="imu", at=AT)


def frames_of_sensors(names: FrameNames, *mounts: tuple[str, str]) -> list[str]:
    """Return the frames of sensors, from tuples (link, sensor)."""
    sensors = {link: tuple(sensor(name) for parent, name in mounts if parent == link) for link, _ in mounts}
    model = Model(name="bot", at=AT, links=tuple(Link(name=n, at=AT, sensors=s) for n, s in sensors.items()))
    return [names.sensor(model, link, sensor(name), rest="_x" if name == "eye" else "") for link, name in mounts]


def test_sensors_of_the_same_name_have_distinct_frames() -> None:
    """Two cameras `eye` of one model, and an imu on a nested model's link."""
    frames = frames_of_sensors(FrameNames(), ("left", "eye"), ("right", "eye"), ("arm::left", "imu"))

    assert frames == ["bot/left/eye_x", "bot/right/eye_x", "bot/imu"]


def test_a_sensor_named_like_a_link_has_another_frame() -> None:
    """This includes lumped links of a URDF, which are not simulated."""
    robot = Robot(name="bot", at=AT, root="mast", links=(RobotLink(name="mast", at=AT),), joints=())
    frames = frames_of_sensors(FrameNames.from_robot(robot), ("base", "imu"), ("imu", "base"), ("base", "mast"))

    assert frames == ["imu_sensor", "base_sensor", "mast_sensor"]
