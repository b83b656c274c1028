"""Directional and torsional friction, from the file to the motion, against mechanics."""

import math
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest
from tests.sim.physics.surface_world import BALL, BLOCK, G, body, floor, friction, load_models

from trundle.sim.simulation import Simulation
from trundle.spatial import Twist, Wrench

Load = Callable[..., Simulation]


@pytest.fixture
def load(tmp_path: Path) -> Load:
    """Load models in a world."""
    return partial(load_models, tmp_path)


@pytest.mark.parametrize(
    ("direction", "slides"), [("1 0 0", True), ("0 1 0", False), ("0.001 2 5", False), ("0 0 1", False)]
)
def test_a_block_slides_along_its_grain_and_sticks_across_it(load: Load, direction: str, slides: bool) -> None:
    # Down a slope of 20 degrees along the block's x.
    tilt = math.radians(20.0)
    surface = friction(0.1, 5.0, f"<fdir1>{direction}</fdir1>")
    sim = load(floor(friction(10.0), tilt=tilt), body("b", BLOCK, surface, pose=f"0.0171 0 0.047 0 {tilt} 0"))
    sim.run(0.3)
    x = sim["b"].pose.position[0]
    speed = sim["b"].link("l").twist.linear[0]
    sim.run(1.0)
    moved = sim["b"].pose.position[0] - x
    a = G * (math.sin(tilt) - 0.1 * math.cos(tilt)) * math.cos(tilt)
    assert moved == pytest.approx(speed * 1.0 + a / 2 if slides else 0.0, rel=0.01, abs=1e-4)
    assert (speed > 0.3) is slides


@pytest.mark.parametrize(("direction", "speed"), [((1.0, 0.0), 0.0), ((0.0, 1.0), 0.2 * G * 0.5)])
def test_the_friction_direction_of_a_static_surface_is_ignored(
    load: Load, direction: tuple[float, float], speed: float
) -> None:
    """Gazebo computes the second collision's fdir1 and leaves it unused; ODE's second is the larger of the two."""
    ground = floor(friction(0.1, 0.5, "<fdir1>1 0 0</fdir1>"))
    sim = load(ground, body("b", BLOCK, friction(10.0), pose="0 0 0.05 0 0 0"))
    sim.run(0.05)
    block = sim["b"].link("l")
    block.apply_wrench(Wrench(force=(0.3 * G * direction[0], 0.3 * G * direction[1], 0.0)))
    sim.run(0.5)
    assert math.hypot(*block.twist.linear) == pytest.approx(speed, rel=0.01, abs=1e-3)
    message = "collision 'c': its <fdir1> does not count: as in Gazebo, the moving collision's does"
    assert message in [finding.what for finding in sim.report.findings]


@pytest.mark.parametrize(("fdir1", "grip"), [("1 0 0", 0.5), ("0 0 1", 0.2)])
def test_a_spinning_wheel_pulls_by_the_friction_direction_that_turns_with_it(
    load: Load, fdir1: str, grip: float
) -> None:
    """The direction turns with the wheel; its component within the floor acts, at any angle of the wheel."""
    surface = friction(0.5, 0.2, f"<fdir1>{fdir1}</fdir1>")
    wheels = "".join(
        f'<link name="w{i}"><pose>{x} {y} 0.1 {-math.pi / 2} 0 0</pose><inertial><mass>1</mass><inertia>'
        '<ixx>0.003</ixx><iyy>0.003</iyy><izz>0.005</izz></inertia></inertial><collision name="c"><geometry>'
        "<cylinder><radius>0.1</radius><length>0.04</length></cylinder></geometry>"
        f"<surface>{surface}</surface></collision></link>"
        f'<joint name="w{i}" type="revolute"><parent>base</parent><child>w{i}</child><axis><xyz>0 0 1</xyz></axis>'
        "</joint>"
        for i, (x, y) in enumerate((x, y) for x in (0.4, -0.4) for y in (0.3, -0.3))
    )
    base = (
        '<link name="base"><pose>0 0 0.1 0 0 0</pose><inertial><mass>16</mass><inertia><ixx>1</ixx><iyy>1</iyy>'
        "<izz>1</izz></inertia></inertial></link>"
    )
    sim = load(floor(friction(10.0)), f'<model name="car">{base}{wheels}</model>')
    sim.run(0.1)
    for i in range(4):
        sim["car"].joint(f"w{i}").command_velocity(200.0, max_effort=4.0)
    sim.run(1.2)
    before = sim["car"].link("base").twist.linear[0]
    speeds: list[float] = []
    for _ in range(500):
        sim.step()
        speeds.append(sim["car"].joint("w0").velocity)
    assert sim["car"].link("base").twist.linear[0] - before == pytest.approx(grip * G * 0.5, rel=0.02)
    assert speeds == pytest.approx([200.0] * 500, rel=0.01)


@pytest.mark.parametrize("fdir1", ["", "<fdir1>1 0 0</fdir1>", "<fdir1>0 1 0</fdir1>", "<fdir1>1 1 0</fdir1>"])
@pytest.mark.parametrize(("mu", "mu2"), [(0.5, 0.0), (0.0, 0.5)])
def test_friction_in_one_direction_acts_without_friction_in_the_other(
    load: Load, mu: float, mu2: float, fdir1: str
) -> None:
    """ODE's first direction on a level floor is y where the file names none."""
    x, y = {"": (0, 1), "<fdir1>1 0 0</fdir1>": (1, 0), "<fdir1>0 1 0</fdir1>": (0, 1)}.get(fdir1, (1, 1))
    first = (x / math.hypot(x, y), y / math.hypot(x, y))
    second = (-first[1], first[0])
    sim = load(floor(friction(10.0)), body("b", BLOCK, friction(mu, mu2, fdir1), pose="0 0 0.05 0 0 0"))
    sim.run(0.05)
    block = sim["b"].link("l")
    for direction, grip in ((first, mu), (second, mu2)):
        before = block.twist.linear
        push = 0.8 * G  # more than friction holds
        block.apply_wrench(Wrench(force=(push * direction[0], push * direction[1], 0.0)), duration_s=0.2)
        sim.run(0.2)
        gained = [after - old for after, old in zip(block.twist.linear, before, strict=True)]
        along = gained[0] * direction[0] + gained[1] * direction[1]
        assert along == pytest.approx(0.2 * (push - grip * G), rel=0.01)


@pytest.mark.parametrize(("normal", "across"), [("1 0 0", (0.0, 1.0, 0.0)), ("0 1 0", (1.0, 0.0, 0.0))])
def test_the_first_friction_direction_on_a_wall_is_horizontal(
    load: Load, normal: str, across: tuple[float, ...]
) -> None:
    """Without fdir1 ODE chooses it (dPlaneSpace), for any normal of the wall: so a gripper holds by mu2."""
    plane = f"<plane><normal>{normal}</normal><size>100 100</size></plane>"
    out = [float(number) for number in normal.split()]
    cube = "<box><size>0.2 0.2 0.2</size></box>"
    pose = " ".join(str(0.1 * number) for number in out)
    wall = body("wall", plane, friction(10.0), static=True)
    sim = load(wall, body("b", cube, friction(0.2, 0.5), pose=f"{pose} 0 0 0"), gravity=0.0)
    block = sim["b"].link("l")
    for direction, speed in (((0.0, 0.0, 1.0), 0.0), (across, 10.0 * 0.3)):
        pushed = (30.0 * along - 100.0 * away for along, away in zip(direction, out, strict=True))
        block.apply_wrench(Wrench(force=(next(pushed), next(pushed), next(pushed))))
        sim.run(0.3)
        assert math.hypot(*block.twist.linear) == pytest.approx(speed, rel=0.02, abs=1e-3)


def test_a_patch_of_contact_resists_turning(load: Load) -> None:
    torsional = "<torsional><coefficient>0.8</coefficient><patch_radius>0.05</patch_radius></torsional>"
    sim = load(floor(friction(1.0)), body("b", BALL, friction(1.0, torsional=torsional), pose="0 0 0.1 0 0 0"))
    ball = sim["b"].link("l")
    ball.set_twist(Twist(angular=(0.0, 0.0, 5.0)))
    torque = 3 * math.pi / 16 * 0.05 * 0.8 * G
    sim.run(0.1)
    assert ball.twist.angular[2] == pytest.approx(5.0 - torque / 0.01 * 0.1, rel=0.01)
    sim.run(0.5)
    assert ball.twist.angular[2] == pytest.approx(0.0, abs=1e-3)


def radius(surface_radius: float, kp: float = 1e12) -> str:
    """A patch that grows from a radius, as a whole surface."""
    torsional = f"<use_patch_radius>false</use_patch_radius><surface_radius>{surface_radius}</surface_radius>"
    return friction(1.0, torsional=f"<torsional>{torsional}</torsional>") + (
        f"<contact><ode><kp>{kp}</kp><kd>100</kd></ode></contact>"
    )


@pytest.mark.parametrize("spin", [1.0, 5.0, 20.0])
def test_a_disc_that_spins_on_its_face_stops_by_the_friction_of_its_rim(load: Load, spin: float) -> None:
    """As ODE's, it touches at the rim: ω₀ I / (µ m g r) seconds. It stays down, exactly upright as it is."""
    disc = "<cylinder><radius>0.1</radius><length>0.05</length></cylinder>"
    sim = load(floor(friction(1.0)), body("b", disc, friction(0.5), pose="0 0 0.025 0 0 0"))
    sim.run(0.1)
    sim["b"].set_twist(Twist(angular=(0.0, 0.0, spin)))
    stops = round(spin * 0.01 / (0.5 * G * 0.1) * 1000)
    heights: list[float] = []
    speeds: list[float] = []
    for _ in range(stops + 100):
        sim.step()
        heights.append(sim["b"].pose.position[2])
        speeds.append(sim["b"].link("l").twist.angular[2])
    assert max(heights) - min(heights) < 1e-5
    assert speeds[stops // 2 - 1] == pytest.approx(spin / 2, rel=0.03)
    assert speeds[-1] == pytest.approx(0.0, abs=1e-4)


@pytest.mark.parametrize("kp", [2e4, 1e6, 1e8])
@pytest.mark.parametrize(("below", "curvature"), [(None, 1 / 0.3), (0.2, 1 / 0.3 + 1 / 0.2)])
def test_a_patch_grows_with_the_load_by_its_surface_radius(
    load: Load, kp: float, below: float | None, curvature: float
) -> None:
    """ODE's patch is √(R · depth) wide, load / kp deep, soft or hard; curvatures add up."""
    sim = load(floor("" if below is None else radius(below)), body("b", BALL, radius(0.3, kp), pose="0 0 0.1 0 0 0"))
    sim.run(1.0)
    ball = sim["b"].link("l")
    ball.set_twist(Twist(angular=(0.0, 0.0, 50.0)))
    torque = 3 * math.pi / 16 * math.sqrt(G / kp / curvature) * G
    sim.run(0.2)
    assert 50.0 - ball.twist.angular[2] == pytest.approx(torque / 0.01 * 0.2, rel=0.05)


@pytest.mark.parametrize("torque", [0.05, 0.2])
def test_a_torque_makes_a_patch_slip_up_to_its_friction(load: Load, torque: float) -> None:
    slip = 3.0
    torsional = f"<torsional><patch_radius>0.05</patch_radius><ode><slip>{slip}</slip></ode></torsional>"
    sim = load(floor(), body("b", BALL, friction(1.0, torsional=torsional), pose="0 0 0.1 0 0 0"))
    sim.run(0.1)
    ball = sim["b"].link("l")
    max_torque = min(torque, 3 * math.pi / 16 * 0.05 * G)
    ball.apply_wrench(Wrench(torque=(0.0, 0.0, torque)))
    sim.run(1.0)
    before = ball.twist.angular[2]
    sim.run(0.5)
    if torque > max_torque:
        assert ball.twist.angular[2] - before == pytest.approx((torque - max_torque) / 0.01 * 0.5, rel=0.01)
    else:
        assert ball.twist.angular[2] == pytest.approx(slip * torque, rel=2e-3)


@pytest.mark.parametrize(("gain", "swings"), [(1.0, True), (0.5, False)])
def test_a_wheel_controller_oscillates_where_its_gain_overshoots(load: Load, gain: float, swings: bool) -> None:
    """Gain · step / inertia is 2.43 and 1.21; beyond 2 a step overshoots by more than was missing, up to the limit."""
    inertia, limit, target = 4.1226e-4, 10.0, 10.0
    moments = "".join(f"<{m}>{inertia}</{m}>" for m in ("ixx", "iyy", "izz"))
    wheel = (
        f'<link name="w"><inertial><mass>0.3</mass><inertia>{moments}</inertia></inertial></link>'
        '<joint name="w" type="revolute"><parent>world</parent><child>w</child><axis><xyz>0 1 0</xyz></axis></joint>'
    )
    sim = load(f'<model name="m">{wheel}</model>')
    joint, speed = sim["m"].joint("w"), 0.0
    speeds: list[float] = []
    for _ in range(200):
        effort = min(max(gain * (target - speed), -limit), limit)
        speed += effort / inertia * 0.001
        joint.command_effort(effort)
        sim.step()
        speeds.append(joint.velocity)
        assert joint.velocity == pytest.approx(speed, abs=1e-6)
    assert (max(speeds[100:]) - min(speeds[100:]) > 20.0) is swings
