"""Surfaces that move and slip under a block of 2 kg, against m dv/dt = F − v / slip."""

import math
from pathlib import Path

import pytest
from msgspec.structs import replace

import trundle
from trundle.sim.physics import SurfaceMotion, TrackMotion
from trundle.sim.simulation import Simulation
from trundle.spatial import Wrench

X, Y = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
MASS, MU = 2.0, 0.8
BLOCK = f"""<model name="{{}}"><pose>{{}} 0 0.1 0 0 0</pose><link name="l"><inertial><mass>{MASS}</mass><inertia>
<ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial><collision name="c"><geometry><box><size>0.4 0.4 0.2
</size></box></geometry><surface><friction><ode><mu>{MU}</mu><mu2>{MU}</mu2></ode></friction></surface></collision></link>
</model>"""
FLOOR = """<model name="floor"><static>true</static><link name="l"><collision name="c"><geometry><plane><normal>0 0 1
</normal></plane></geometry></collision></link></model>"""


@pytest.fixture
def sim(tmp_path: Path) -> Simulation:
    file = tmp_path / "w.sdf"
    models = FLOOR + BLOCK.format("block", 0) + BLOCK.format("other", 5)
    file.write_text(f'<sdf version="1.6"><world name="w"><gravity>0 0 -10</gravity>{models}</world></sdf>')
    return trundle.load(str(file))


def test_a_belt_carries_a_block_against_its_own_motion(sim: Simulation) -> None:
    """Friction of 0.8 brings it to 0.5 m/s in 62.5 ms; the block next to it stays."""
    sim["block"].link("l").set_surface_motion(SurfaceMotion(direction=X, speed=-0.5))
    sim.run(1.0)

    assert sim["block"].link("l").twist.linear == pytest.approx((0.5, 0, 0), abs=1e-5)
    assert sim["block"].pose.position[0] == pytest.approx(0.5 - 0.5 * 0.0625 / 2, abs=0.004)
    assert sim["other"].link("l").twist.linear == pytest.approx((0, 0, 0), abs=1e-5)
    sim["block"].link("l").set_surface_motion(None)
    sim.run(0.5)
    assert sim["block"].link("l").twist.linear == pytest.approx((0, 0, 0), abs=1e-5)


def test_only_the_running_one_of_two_static_belts_carries(tmp_path: Path) -> None:
    belt = """<model name="{}"><static>true</static><pose>{} 0 0.05 0 0 0</pose><link name="l"><collision name="c">
    <geometry><box><size>2 2 0.1</size></box></geometry></collision></link></model>"""
    models = belt.format("runs", 0) + belt.format("rests", 5) + BLOCK.format("block", 0) + BLOCK.format("other", 5)
    file = tmp_path / "w.sdf"
    models = models.replace(" 0 0.1 0 0 0<", " 0 0.2 0 0 0<")
    file.write_text(f'<sdf version="1.6"><world name="w"><gravity>0 0 -10</gravity>{models}</world></sdf>')
    sim = trundle.load(str(file))
    sim["runs"].link("l").set_surface_motion(SurfaceMotion(direction=X, speed=0.5))
    sim.run(1.0)

    assert sim["block"].link("l").twist.linear == pytest.approx((0.5, 0, 0), abs=1e-5)
    assert sim["other"].link("l").twist.linear == pytest.approx((0, 0, 0), abs=1e-5)


def test_a_track_drives_its_robot_and_skids_about_the_centre_of_rotation(tmp_path: Path) -> None:
    """Straight on it drives at the belt's speed; turning, friction acts across the way to that point alone."""
    file = tmp_path / "w.sdf"
    slippery = BLOCK.format("block", 0).replace(f"<mu2>{MU}</mu2>", "<mu2>0.001</mu2>")
    file.write_text(f'<sdf version="1.6"><world name="w"><gravity>0 0 -10</gravity>{FLOOR}{slippery}</world></sdf>')
    sim = trundle.load(str(file))
    link = sim["block"].link("l")
    link.set_surface_motion(TrackMotion(axis=Y, speed=0.5))
    sim.run(1.0)
    assert link.twist.linear == pytest.approx((0.5, 0, 0), abs=1e-3)

    # From far along y, the belt's way is across x: friction along y, which the belt does not move along, holds on.
    link.set_surface_motion(TrackMotion(axis=Y, speed=0.5, centre=(link.pose.position[0], 500.0, 0.1)))
    link.apply_wrench(Wrench(force=(0.0, 10.0, 0.0)))
    sim.run(0.5)
    assert link.twist.linear[1] > 1.0, "along the way to the point nothing holds"
    assert link.twist.linear[0] == pytest.approx(0.5, abs=0.05), "across it the belt does"


@pytest.mark.parametrize("along", [X, Y])
def test_slip_grows_with_the_force_and_friction_holds_across_it(sim: Simulation, along: tuple[float, ...]) -> None:
    """v = F · slip · (1 − e^(−t / (m · slip))), with a direction that slips along or across the one given."""
    slip = 0.1
    link = sim["block"].link("l")
    sideways = along == Y
    link.set_surface_motion(
        SurfaceMotion(direction=Y, slip_across=slip)
        if sideways
        else SurfaceMotion(direction=(1.0, 0.0, 0.4), slip=slip)
    )
    sim.run(0.1)
    link.apply_wrench(Wrench(force=(5.0, 5.0, 0.0)))
    sim.run(0.3)

    vx, vy, _ = link.twist.linear
    assert vx == pytest.approx(5.0 * slip * (1 - math.exp(-0.3 / (MASS * slip))), rel=5e-3)
    assert vy == pytest.approx(0.0, abs=1e-4)


def test_beyond_friction_a_slipping_surface_slides(sim: Simulation) -> None:
    link = sim["block"].link("l")
    link.set_surface_motion(SurfaceMotion(direction=X, slip=0.001))
    sim.run(0.1)
    link.apply_wrench(Wrench(force=(MU * MASS * 10 + 4.0, 0.0, 0.0)))
    sim.run(0.2)
    before = link.twist.linear[0]
    sim.run(0.5)

    assert link.twist.linear[0] - before == pytest.approx(4.0 / MASS * 0.5, rel=1e-2)


def test_contact_laws_survive_spawns_and_deletions_and_saved_states_repeat(sim: Simulation) -> None:
    link = sim["block"].link("l")
    link.set_surface_motion(SurfaceMotion(direction=X, speed=-0.5, slip=0.01))
    sim.delete("floor")
    sim.spawn(replace(sim["other"].model, name="third"))
    sim.delete("third")
    sim.run(0.05)
    assert link.twist.linear[0] == 0.0, "nothing to push against"

    floor = trundle.load("empty.world").world.models[0]
    sim.spawn(floor)
    link.set_pose(replace(link.pose, position=(0.0, 0.0, 0.1)))
    sim.run(0.1)
    saved = sim.save()
    runs: list[tuple[float, ...]] = []
    for _ in range(2):
        sim.restore(saved)
        sim.run(0.2)
        runs.append((*link.pose.position, *link.twist.linear))
    assert runs[0] == runs[1]
    assert runs[0][3] > 0.1
