"""Tracks and tyres, against the kinematics of rolling and slipping."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.gazebo.plugins.plugin_world import BODY, FakeNode, load

from trundle.sim.physics import Engine, WheelGrip
from trundle.sim.simulation import Simulation
from trundle.spatial import Wrench

TRACK = """<link name="{side}"><pose>0 {y} 0.05 0 0 0</pose><inertial><mass>5</mass><inertia><ixx>0.1</ixx>
<iyy>0.1</iyy><izz>0.1</izz></inertia></inertial><collision name="c"><geometry><box><size>0.4 0.01 0.1</size></box>
</geometry></collision></link><joint name="{side}_joint" type="fixed"><parent>base</parent>
<child>{side}</child></joint>"""
TANK = f'<link name="base"><pose>0 0 0.2 0 0 0</pose>{BODY.format(10)}</link>' + "".join(
    TRACK.format(side=side, y=y) for side, y in (("left", 0.2), ("right", -0.2))
)
SIMPLE = '<plugin name="p" filename="libSimpleTrackedVehiclePlugin.so">{}</plugin>'
PARTS = "<body>base</body><left_track>left</left_track><right_track>right</right_track>"
WHEEL = """<link name="{name}"><pose>{x} {y} 0.1 -1.5707963 0 0</pose><inertial><mass>1</mass><inertia><ixx>0.005</ixx>
<iyy>0.005</iyy><izz>0.008</izz></inertia></inertial><collision name="c"><geometry><cylinder><radius>0.1</radius>
<length>0.02</length></cylinder></geometry></collision></link><joint name="{name}" type="revolute"><parent>base</parent>
<child>{name}</child><axis><xyz>0 1 0</xyz><use_parent_model_frame>1</use_parent_model_frame></axis></joint>"""
NAMES = ("l1", "l2", "r1", "r2")
CAR = f'<link name="base"><pose>0 0 0.1 0 0 0</pose>{BODY.format(6)}</link>' + "".join(
    WHEEL.format(name=name, x=x, y=y) for name, x, y in zip(NAMES, (0.2, -0.2) * 2, (0.2, 0.2, -0.2, -0.2), strict=True)
)
GRAVITY = "0 0 -9.8"


def drive(sim: Simulation, node: FakeNode, speed: float, yaw: float, *, seconds: float) -> tuple[float, float]:
    """Command a speed and a yaw; return the final forward speed and yaw rate."""
    turn = {"z": math.sin(yaw / 2), "w": math.cos(yaw / 2)}
    node.receive("/m/cmd_vel", position={"x": speed}, orientation=turn)
    sim.run(seconds)
    link = sim["m"].link("base")
    return link.pose.inverse().transform_vector(link.twist.linear)[0], link.twist.angular[2]


def test_a_tracked_vehicle_drives_at_its_command(tmp_path: Path) -> None:
    """Contacts are as far ahead of the centre as beside it: the steering efficiency is 0.5, the default."""
    node = FakeNode()
    sim = load(tmp_path, TANK + SIMPLE.format(PARTS), gravity=GRAVITY, ground=True, node=node)

    assert drive(sim, node, 0.5, 0.0, seconds=1.0) == pytest.approx((0.5, 0.0), abs=1e-3)
    assert sim["m"].link("base").pose.position[0] == pytest.approx(0.5, abs=0.05)
    assert drive(sim, node, 0.0, 0.5, seconds=1.0) == pytest.approx((0.0, -0.5), abs=0.02)
    assert drive(sim, node, 9.0, 0.0, seconds=1.0) == pytest.approx((1.0, 0.0), abs=1e-3)
    sim.reset()
    sim.run(0.5)
    assert sim["m"].link("base").twist.linear == pytest.approx((0, 0, 0), abs=1e-4)
    assert [message.x for message in node.published["/m/tracks_speed"]] == pytest.approx([0.5, 0.2, 1.0, 0.0])
    assert [message.y for message in node.published["/m/tracks_speed"]] == pytest.approx([0.5, -0.2, 1.0, 0.0])


@pytest.mark.parametrize("seed", range(4))
def test_a_tracked_vehicle_of_any_size_drives_and_turns_with_its_tracks(tmp_path: Path, seed: int) -> None:
    """In a turn on the spot, corners at (x, y) follow the belt speed s along their circle: the yaw rate is
    s y / (x² + y²)."""
    rng = np.random.default_rng(seed)
    length, half_track, mass, efficiency = rng.uniform(0.2, 1.2), rng.uniform(0.15, 0.6), 10 ** rng.uniform(0, 2.5), 0.5
    track = """<link name="{side}"><pose>0 {y} 0.05 0 0 0</pose><inertial><mass>{mass}</mass><inertia><ixx>0.1</ixx>
    <iyy>0.1</iyy><izz>0.1</izz></inertia></inertial><collision name="c"><geometry><box><size>{length} 0.01 0.1</size>
    </box></geometry></collision></link><joint name="{side}_joint" type="fixed"><parent>base</parent>
    <child>{side}</child></joint>"""
    tank = f'<link name="base"><pose>0 0 0.2 0 0 0</pose>{BODY.format(mass)}</link>' + "".join(
        track.format(side=side, y=y, mass=mass / 4, length=length)
        for side, y in (("left", half_track), ("right", -half_track))
    )
    parameters = f"<steering_efficiency>{efficiency}</steering_efficiency>"
    parameters += f"<tracks_separation>{2 * half_track}</tracks_separation>"
    node = FakeNode()
    sim = load(tmp_path, tank + SIMPLE.format(PARTS + parameters), gravity=GRAVITY, ground=True, node=node)

    speed, yaw = rng.uniform(-0.9, 0.9), rng.uniform(0.2, 0.8)
    motion = drive(sim, node, speed, 0.0, seconds=1.0)
    belt = min(yaw * half_track / efficiency, 1.0)
    yaw_rate = -belt * half_track / ((length / 2) ** 2 + half_track**2)
    turn_motion = drive(sim, node, 0.0, yaw, seconds=1.5)
    assert motion == pytest.approx((speed, 0.0), abs=2e-3)
    assert turn_motion == pytest.approx((0.0, yaw_rate), rel=0.02, abs=2e-3)


def test_tracks_have_the_friction_of_the_plugin(tmp_path: Path) -> None:
    """On ice of 0.05 a tank of 20 kg gains 0.05 · g at most."""
    node = FakeNode()
    friction = "<track_mu>0.05</track_mu><track_mu2>0.05</track_mu2>"
    sim = load(tmp_path, TANK + SIMPLE.format(PARTS + friction), gravity=GRAVITY, ground=True, node=node)
    sim.run(0.2)

    speed, _ = drive(sim, node, 1.0, 0.0, seconds=0.5)
    assert speed == pytest.approx(0.05 * 9.8 * 0.5, rel=0.02)


def test_wheels_of_a_side_turn_at_one_speed(tmp_path: Path) -> None:
    node = FakeNode()
    joints = "".join(f"<{side}_joint>{side[0]}{i}</{side}_joint>" for side in ("left", "right") for i in (1, 2))
    plugin = f'<plugin name="p" filename="libWheelTrackedVehiclePlugin.so">{joints}</plugin>'
    sim = load(tmp_path, CAR + plugin, gravity=GRAVITY, ground=True, node=node)

    assert drive(sim, node, 0.4, 0.0, seconds=2.0)[0] == pytest.approx(0.4, rel=0.02)
    drive(sim, node, 0.0, 0.5, seconds=1.0)
    assert sim["m"].joint("l1").velocity == pytest.approx(0.5 * 0.2 / 0.5 / 0.1, rel=0.05)
    assert sim["m"].joint("r2").velocity == pytest.approx(-0.5 * 0.2 / 0.5 / 0.1, rel=0.05)


def load_car(
    folder: Path, *, lateral: float, longitudinal: float, wheel_rate: float = 20.0, node: FakeNode | None = None
) -> Simulation:
    """Return a car of 10 kg with driven wheels of 0.1 m, each under 24.5 N."""
    wheels = "".join(
        f'<wheel link_name="{name}"><slip_compliance_lateral>{lateral}</slip_compliance_lateral>'
        f"<slip_compliance_longitudinal>{longitudinal}</slip_compliance_longitudinal>"
        "<wheel_normal_force>24.5</wheel_normal_force></wheel>"
        for name in NAMES
    )
    plugin = f'<plugin name="p" filename="libWheelSlipPlugin.so">{wheels}</plugin>'
    sim = load(folder, CAR + plugin, gravity=GRAVITY, ground=True, node=node)
    assert sim.report.warnings == []
    for name in NAMES:
        sim["m"].joint(name).command_velocity(wheel_rate, max_effort=100.0)
    return sim


@pytest.mark.parametrize("compliance", [0.1, 0.5])
@pytest.mark.parametrize("wheel_rate", [20.0, 2.0])
def test_longitudinal_slip_is_compliance_times_force_ratio(
    tmp_path: Path, compliance: float, wheel_rate: float
) -> None:
    sim = load_car(tmp_path, lateral=0.0, longitudinal=compliance, wheel_rate=wheel_rate)
    sim.run(1.0)
    assert sim["m"].link("base").twist.linear[0] == pytest.approx(0.1 * wheel_rate, rel=2e-3)

    sim["m"].link("base").apply_wrench(Wrench(force=(-20.0, 0.0, 0.0)))
    sim.run(1.0)
    tread = sim["m"].joint("l1").velocity * 0.1
    assert sim["m"].link("base").twist.linear[0] == pytest.approx(tread * (1 - compliance * 5.0 / 24.5), rel=2e-3)


def test_wheel_slip_needs_no_python_at_each_step(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without subscribers the engine steps by itself, a second in a few strides."""
    sim = load_car(tmp_path, lateral=0.1, longitudinal=0.1)
    strides: list[int] = []
    step = Engine.step

    def counted_step(engine: Engine, count: int, *recorders: Any) -> int:
        strides.append(count)
        return step(engine, count, *recorders)

    monkeypatch.setattr(Engine, "step", counted_step)
    sim.run(1.0)
    assert sum(strides) == 1000
    assert len(strides) < 20


def test_an_axle_transmits_the_force_of_a_slipping_tyre(tmp_path: Path) -> None:
    """Also after a change of the compliance."""
    sim = load_car(tmp_path, lateral=0.0, longitudinal=0.0)
    assert sim["m"].joint("l1").reaction.force[1] == pytest.approx(0.0, abs=1.0)
    sim.run(1.0)
    for name in NAMES:
        sim["m"].link(name).set_surface_motion(WheelGrip(axis=(0.0, 0.0, 1.0), slip=2e-3, slip_across=0.0))
    sim["m"].link("base").apply_wrench(Wrench(force=(0.0, 20.0, 0.0)))
    sim.run(1.5)
    assert sim["m"].link("base").twist.linear[1] == pytest.approx(20.0 * 2e-3 / 4 * 20.0, rel=0.03)
    assert sum(sim["m"].joint(name).reaction.force[1] for name in NAMES) == pytest.approx(20.0, rel=0.02)


def test_lateral_slip_follows_its_compliance_and_is_zero_at_rest(tmp_path: Path) -> None:
    node = FakeNode()
    sim = load_car(tmp_path, lateral=0.2, longitudinal=0.0, node=node)
    base = sim["m"].link("base")
    base.apply_wrench(Wrench(force=(0.0, 20.0, 0.0)))
    sim.run(1.5)

    sideways = 2.0 * 0.2 * 5.0 / 24.5
    assert base.pose.inverse().transform_vector(base.twist.linear)[1] == pytest.approx(sideways, rel=0.03)
    slip = node.published["/m/wheel_slip/l1"][-1]
    assert (slip.y, slip.z) == pytest.approx((sideways, 2.0), rel=0.03)
    assert slip.x == pytest.approx(0.0, abs=0.01)
    node.receive("/m/wheel_slip/lateral_compliance", data=0.0)
    sim.run(1.0)
    assert base.pose.inverse().transform_vector(base.twist.linear)[1] == pytest.approx(0.0, abs=2e-3)

    for name in NAMES:
        sim["m"].joint(name).command_velocity(0.0, max_effort=100.0)
    sim.run(1.0)
    node.receive("/m/wheel_slip/lateral_compliance", data=0.5)
    sim.run(1.0)
    assert base.twist.linear == pytest.approx((0, 0, 0), abs=1e-3)


def test_the_force_of_a_slipping_wheel_is_limited_by_friction(tmp_path: Path) -> None:
    """The ground's 100 and the wheels' 1: beyond 98 N the car is dragged."""
    sim = load_car(tmp_path, lateral=0.0, longitudinal=0.1)
    sim.run(0.5)
    sim["m"].link("base").apply_wrench(Wrench(force=(-118.0, 0.0, 0.0)))
    sim.run(0.3)
    before = sim["m"].link("base").twist.linear[0]
    sim.run(0.2)

    assert sim["m"].link("base").twist.linear[0] - before == pytest.approx(-2.0 * 0.2, rel=0.05)


def test_an_invalid_wheel_is_reported(tmp_path: Path) -> None:
    wheels = (
        '<wheel link_name="l1"/><wheel link_name="base"><wheel_normal_force>1</wheel_normal_force></wheel>'
        '<wheel link_name="x"/>'
    )
    sim = load(tmp_path, CAR + f'<plugin name="p" filename="libWheelSlipPlugin.so">{wheels}</plugin>')

    warnings = " ".join(sim.report.warnings)
    assert "<wheel_normal_force> is missing; it does not slip" in warnings
    assert "link 'base' is the child of 0 joints with an axis; one is needed" in warnings
    assert "no link 'x'" in warnings
