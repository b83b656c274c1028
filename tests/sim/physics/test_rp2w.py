"""A published robot stands and rolls as it does in Gazebo."""

import json
import math
from pathlib import Path
from typing import Any

import pytest

from trundle.base.diagnostics import Diagnostics
from trundle.live.world_setup import load_world
from trundle.robots.model import World
from trundle.robots.packages import Packages
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose, Vector3, Wrench

AXLES: dict[str, Vector3] = {
    "left_wheel": (0.0, 0.0, 1.0),
    "right_wheel": (0.0, 0.0, 1.0),
    "front_wheel": (1.0, 0.0, 0.0),
}
"""Axle of each wheel, in its own frame."""


@pytest.fixture(scope="module")
def world(shared: Path) -> World:
    """The RP2W on Gazebo's ground plane."""
    robot = shared / "seeds" / "rp2w" / "model.sdf"
    return load_world(str(robot), Packages({}, start=robot), Diagnostics()).flat


def on_the_ground(world: World) -> Simulation:
    return Simulation(world, Diagnostics())


def angle_between(a: Pose, b: Pose) -> float:
    """[rad]"""
    w, *rest = (a.inverse() @ b).quaternion
    return 2 * math.atan2(math.hypot(*rest), abs(w))


def angle_between_axles(a: Pose, b: Pose, axle: Vector3) -> float:
    """Angle between two axles: `angle_between` without the wheel's own roll [rad]."""
    p, q = a.transform_vector(axle), b.transform_vector(axle)
    return math.acos(min(1.0, sum(x * y for x, y in zip(p, q, strict=True))))


def test_every_joint_moves_except_one_with_limits_0_and_0(world: World) -> None:
    sim = on_the_ground(world)
    compiled = sim.engine.compiled
    stuck = [name for name, axes in zip(compiled.joint_names, compiled.joint_axes, strict=True) if not axes]
    assert stuck == ["my_robot::chassis_body"]
    assert compiled.model.nv == 6 + 5


def test_the_robot_stands_for_ten_seconds_at_gazebos_pose(world: World, shared: Path) -> None:
    samples: list[dict[str, Any]] = json.loads((shared / "peers" / "gazebo_rp2w.json").read_text())["samples"]
    last = samples[-1]
    assert last["t"] == 10
    sim = on_the_ground(world)
    sim.run(10.0)
    for link in sim["my_robot"].links:
        gazebo = last["links"][f"my_robot::{link.name}"]
        expected = Pose(tuple(gazebo["pos"]), tuple(gazebo["quat_wxyz"]))
        assert link.pose.position == pytest.approx(expected.position, abs=1e-3), link.name
        axle = AXLES.get(link.name)
        turned = angle_between_axles(link.pose, expected, axle) if axle else angle_between(link.pose, expected)
        assert turned < 1e-3, link.name


def test_a_push_of_15_newton_rolls_the_robot_as_a_rigid_body(world: World) -> None:
    sim = on_the_ground(world)
    chassis = sim["my_robot"].link("chassis")
    y = chassis.pose.position[1]
    chassis.apply_wrench(Wrench(force=(0.0, 15.0, 0.0)))
    sim.run(10.0)
    # Rolling without slip against the wheels' joint friction gives 0.4117 m; Gazebo 0.4225.
    assert chassis.pose.position[1] - y == pytest.approx(0.412, rel=0.02)


def test_wheel_friction_holds_the_robot_against_5_newton(world: World) -> None:
    sim = on_the_ground(world)
    chassis = sim["my_robot"].link("chassis")
    y = chassis.pose.position[1]
    chassis.apply_wrench(Wrench(force=(0.0, 5.0, 0.0)))
    sim.run(10.0)
    # Gazebo lets it creep 4.2 mm.
    assert abs(chassis.pose.position[1] - y) < 1e-3


def test_a_sideways_push_at_the_camera_tips_the_robot_as_in_gazebo(world: World) -> None:
    sim = on_the_ground(world)
    robot = sim["my_robot"]
    robot.link("camera").apply_wrench(Wrench(force=(20.0, 0.0, 0.0)))
    while abs(robot.link("chassis").pose.rpy[1]) < 0.5 and sim.time_ns < 3e9:
        sim.step()
    # Gazebo's pitch passes 0.5 rad at 0.62 s.
    assert sim.time_ns * 1e-9 == pytest.approx(0.62, abs=0.03)
