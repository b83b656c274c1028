"""Gazebo's own plugins, each on a small model."""

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import trundle
from trundle.gazebo.model_plugins import load_plugins
from trundle.gazebo.plugins.gazebo.bounding_box import bounding_box
from trundle.gazebo.plugins.gazebo.diff_drive import DiffDrive
from trundle.gazebo.plugins.gazebo.skid_steer_drive import SkidSteerDrive
from trundle.robots.model import Box, Cylinder, Link
from trundle.sim.simulation import Simulation
from trundle.spatial import Twist, Vector3

BODY = "<inertial><mass>{}</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>"
WHEEL = """<link name="{name}"><pose>{x} {y} 0.1 -1.5707963 0 0</pose><inertial><mass>1</mass><inertia><ixx>0.005</ixx>
<iyy>0.005</iyy><izz>0.008</izz></inertia></inertial><collision name="c"><geometry><cylinder><radius>0.1</radius>
<length>0.02</length></cylinder></geometry></collision></link><joint name="{name}" type="revolute"><parent>base</parent>
<child>{name}</child><axis><xyz>0 1 0</xyz></axis></joint>"""


def load(folder: Path, body: str, *, gravity: str = "0 0 -9.8", ground: bool = False) -> Simulation:
    plane = "<include><uri>model://ground_plane</uri></include>" if ground else ""
    file = folder / "w.sdf"
    file.write_text(
        f'<sdf version="1.4"><world name="w"><physics type="ode"><gravity>{gravity}</gravity></physics>{plane}'
        f'<model name="m">{body}</model></world></sdf>'
    )
    sim = trundle.load(str(file))
    load_plugins(sim, None, {}, log=lambda _: None)
    assert not [finding for finding in sim.report.warnings if "plugin" in finding]
    return sim


def test_a_neutrally_buoyant_body_stays_still(tmp_path: Path) -> None:
    """A 0.1 m cube displaces 0.9991 kg; a second cube with twice that volume rises with g."""
    cube = '<collision name="c"><geometry><box><size>0.1 0.1 0.1</size></box></geometry></collision>'
    links = "".join(
        f'<link name="{name}"><pose>0 {y} 0 0 0 0</pose>{BODY.format(0.9991026)}{cube}</link>'
        for y, name in enumerate(("hangs", "rises"))
    )
    declared = '<link name="rises"><center_of_volume>0 0 0</center_of_volume><volume>0.002</volume></link>'

    sim = load(tmp_path, f'{links}<plugin name="p" filename="libBuoyancyPlugin.so">{declared}</plugin>')
    sim.run(1.0)

    assert sim["m"].link("hangs").pose.position[2] == pytest.approx(0.0, abs=1e-6)
    assert sim["m"].link("rises").twist.linear[2] == pytest.approx(9.8, rel=1e-3)


def _shape(rng: np.random.Generator) -> tuple[str, float]:
    """Return a random shape and its volume [m³]."""
    a, b, c = rng.uniform(0.1, 0.5, 3)
    shapes = (
        (f"<box><size>{a} {b} {c}</size></box>", a * b * c),
        (f"<cylinder><radius>{a}</radius><length>{b}</length></cylinder>", math.pi * a**2 * b),
        (f"<sphere><radius>{a}</radius></sphere>", 4 / 3 * math.pi * a**3),
        (f"<ellipsoid><radii>{a} {b} {c}</radii></ellipsoid>", 4 / 3 * math.pi * a * b * c),
        (f"<capsule><radius>{a}</radius><length>{b}</length></capsule>", math.pi * a**2 * (b + 4 / 3 * a)),
    )
    return shapes[rng.integers(len(shapes))]


@pytest.mark.parametrize("seed", range(6))
def test_a_body_rises_and_rights_itself_in_any_fluid(tmp_path: Path, seed: int) -> None:
    """Shape, density, mass, moment and centre of volume are random: m z'' = B − m g, I θ'' = −B (x cos θ + z sin θ)."""
    rng = np.random.default_rng(seed)
    shape, volume = _shape(rng)
    density, ratio, moment = 10 ** rng.uniform(0, 3.2), rng.uniform(0.3, 2.0), 10 ** rng.uniform(-2, 1)
    mass = ratio * density * volume
    x, z = rng.uniform(-0.2, 0.2, 2)
    moments = "".join(f"<i{axis}>{moment}</i{axis}>" for axis in ("xx", "yy", "zz"))
    link = f"""<link name="a"><inertial><mass>{mass}</mass><inertia>{moments}</inertia></inertial>
    <collision name="c"><pose>{x} 0 {z} 0.3 0.2 0.1</pose><geometry>{shape}</geometry></collision></link>"""
    fluid = f"<fluid_density>{density}</fluid_density>"
    sim = load(tmp_path, f'{link}<plugin name="p" filename="libBuoyancyPlugin.so">{fluid}</plugin>')
    lift = density * volume * 9.8

    def turn(_time: float, state: tuple[float, float]) -> tuple[float, float]:
        angle, rate = state
        return rate, -lift / moment * (x * math.cos(angle) + z * math.sin(angle))

    seconds = min(1.0, math.sqrt(20 * moment / lift / math.hypot(x, z)))
    sim.run(seconds)
    seconds = sim.time_ns / 1e9
    truth = solve_ivp(turn, (0, seconds), (0.0, 0.0), method="DOP853", rtol=1e-10, atol=1e-12).y[:, -1]
    body = sim["m"].link("a")
    roll, pitch, _ = body.pose.rpy
    assert body.pose.position[2] == pytest.approx((1 / ratio - 1) * 9.8 * seconds**2 / 2, rel=0.005)
    pitch = math.pi - pitch if abs(roll) > 1.0 else pitch
    assert math.remainder(pitch - truth[0], math.tau) == pytest.approx(0.0, abs=0.005)
    assert body.twist.angular[1] == pytest.approx(truth[1], rel=0.01, abs=0.01)


def test_a_model_starts_with_its_initial_velocity(tmp_path: Path) -> None:
    motion = "<linear>1 0 0</linear><angular>0 0 2</angular>"
    plugin = f'<plugin name="p" filename="libInitialVelocityPlugin.so">{motion}</plugin>'

    sim = load(tmp_path, f'<link name="a">{BODY.format(1)}</link>{plugin}', gravity="0 0 0")
    sim.run(1.0)

    assert sim["m"].pose.position == pytest.approx((1, 0, 0), abs=1e-3)
    assert sim["m"].pose.rpy[2] == pytest.approx(2.0, abs=2e-3)


def test_initial_velocity_applies_to_each_link_at_its_origin(tmp_path: Path) -> None:
    motion = "<linear>1 0 0</linear><angular>0 0 2</angular>"
    plugin = f'<plugin name="p" filename="libInitialVelocityPlugin.so">{motion}</plugin>'
    links = f'<link name="a">{BODY.format(1)}</link><link name="b"><pose>0 3 0 0 0 0.5</pose>{BODY.format(2)}</link>'

    sim = load(tmp_path, f"{links}{plugin}", gravity="0 0 0")
    sim.run(0.5)

    assert sim["m"].link("a").pose.position == pytest.approx((0.5, 0, 0), abs=1e-3)
    assert sim["m"].link("b").pose.position == pytest.approx((0.5, 3, 0), abs=1e-3)
    assert sim["m"].link("b").pose.rpy[2] == pytest.approx(1.5, abs=2e-3)


@pytest.mark.parametrize(
    ("speed", "alpha0", "lift", "drag"),
    [
        (10.0, 0.1, 0.5 * 1.2041 * 100 * 0.4, 0.5 * 1.2041 * 100 * 0.001 * 0.1 / 0.1),
        (0.005, 0.1, 0.0, 0.0),
    ],
)
def test_lift_grows_with_the_angle_of_attack_and_the_squared_speed(tmp_path: Path, speed, alpha0, lift, drag) -> None:
    """Half ρ v² times area, cla·α upwards and cda·α backwards."""
    plugin = f"""<plugin name="p" filename="libLiftDragPlugin.so"><link_name>a</link_name><a0>{alpha0}</a0><cla>4</cla>
    <cda>0.01</cda><area>1</area></plugin>"""

    sim = load(tmp_path, f'<link name="a">{BODY.format(1000)}</link>{plugin}', gravity="0 0 0")
    sim["m"].set_twist(Twist((speed, 0.0, 0.0)))
    sim.run(0.01)

    vx, _, vz = sim["m"].links[0].twist.linear
    assert vz * 1000 / 0.01 == pytest.approx(lift, rel=1e-2, abs=1e-9)
    assert (speed - vx) * 1000 / 0.01 == pytest.approx(drag, rel=1e-2, abs=1e-9)


PRESSURE = 0.5 * 1.2041 * 10.0**2


def degrees(angle: float) -> tuple[float, float]:
    return math.cos(math.radians(angle)), math.sin(math.radians(angle))


@pytest.mark.parametrize(
    ("parameters", "direction", "force"),
    [
        # Sinking at 30 degrees: beyond a stall at 0.3 rad, lift 4 · 0.3 − (0.5236 − 0.3), drag 0.1 · 0.3 + 0.2236.
        (
            "<alpha_stall>0.3</alpha_stall><cla_stall>-1</cla_stall><cda>0.1</cda>",
            (degrees(30)[0], 0.0, -degrees(30)[1]),
            (
                0.9764 * degrees(30)[1] - 0.2536 * degrees(30)[0],
                0.0,
                0.9764 * degrees(30)[0] + 0.2536 * degrees(30)[1],
            ),
        ),
        # Climbing at 30 degrees, the wing is pushed down.
        ("<cda>0</cda>", (degrees(30)[0], 0.0, degrees(30)[1]), (2.0944 * 0.5, 0.0, -2.0944 * degrees(30)[0])),
        # Flow at 45 degrees from the side: half the pressure, and a sweep factor of one half.
        ("<a0>0.1</a0><cda>0</cda>", (*degrees(45), 0.0), (0.0, 0.0, 0.4 * 0.5 * 0.5)),
        # Backwards, α is a0.
        ("<a0>0.1</a0><cda>0</cda>", (-1.0, 0.0, 0.0), (0.0, 0.0, -0.4)),
        # A flap that is down by 0.2 rad.
        (
            "<cda>0</cda><control_joint_name>flap</control_joint_name>"
            "<control_joint_rad_to_cl>-2</control_joint_rad_to_cl>",
            (1.0, 0.0, 0.0),
            (0.0, 0.0, -0.4),
        ),
        # A rod in oblique flow from its left.
        (
            "<cda>0</cda><radial_symmetry>true</radial_symmetry>",
            (degrees(30)[0], degrees(30)[1], 0.0),
            (2.0944 * 0.5, -2.0944 * degrees(30)[0], 0.0),
        ),
    ],
    ids=["stalled", "climbing", "swept", "backwards", "flap", "radial_symmetry"],
)
def test_forces_on_a_wing_for_flow_from_all_directions(
    tmp_path: Path, parameters: str, direction: Vector3, force: Vector3
) -> None:
    """Forces over the pressure of air, in the world; area 1 m², cla 4."""
    flap = (
        f'<link name="flap">{BODY.format(0.001)}</link><joint name="flap" type="revolute"><parent>a</parent>'
        "<child>flap</child><axis><xyz>0 1 0</xyz></axis></joint>"
    )
    plugin = (
        f'<plugin name="p" filename="libLiftDragPlugin.so"><link_name>a</link_name><cla>4</cla>{parameters}</plugin>'
    )
    sim = load(tmp_path, f'<link name="a">{BODY.format(1e6)}</link>{flap}{plugin}', gravity="0 0 0")
    x, y, z = (10.0 * component for component in direction)
    sim["m"].set_twist(Twist((x, y, z)))
    sim["m"].joint("flap").set_position(0.2)
    sim.run(0.01)

    velocity = sim["m"].link("a").twist.linear
    measured = [(after - before) * 1e6 / 0.01 / PRESSURE for after, before in zip(velocity, (x, y, z), strict=True)]
    assert measured == pytest.approx(force, rel=2e-3, abs=2e-3)


def test_two_wings_on_one_link_lift_together(tmp_path: Path) -> None:
    plugin = """<plugin name="p{}" filename="libLiftDragPlugin.so"><link_name>a</link_name><a0>0.1</a0><cla>4</cla>
    <area>0.5</area><cp>0 {} 0</cp></plugin>"""
    wings = plugin.format(1, 1) + plugin.format(2, -1)

    sim = load(tmp_path, f'<link name="a">{BODY.format(1000)}</link>{wings}', gravity="0 0 0")
    sim["m"].set_twist(Twist((10.0, 0.0, 0.0)))
    sim.run(0.01)

    assert sim["m"].links[0].twist.linear[2] * 1000 / 0.01 == pytest.approx(0.5 * 1.2041 * 100 * 0.4, rel=1e-2)
    assert sim["m"].links[0].twist.angular == pytest.approx((0, 0, 0), abs=1e-6)


def wheels(names: tuple[tuple[str, float, float], ...]) -> str:
    return "".join(WHEEL.format(name=name, x=x, y=y) for name, x, y in names)


def command(sim: Simulation, speed: float, yaw_rate: float) -> None:
    """Set the command as the topic's callback does."""
    (plugin,) = (hook for hook in sim.hooks if isinstance(hook, DiffDrive | SkidSteerDrive))
    plugin._command.speed, plugin._command.yaw_rate = speed, yaw_rate


def test_diff_drive_turns_opposite_to_ros_as_in_gazebo(tmp_path: Path) -> None:
    base = f'<link name="base"><pose>0 0 0.1 0 0 0</pose>{BODY.format(5)}'
    base += '<collision name="ball"><pose>-0.2 0 -0.05 0 0 0</pose>'
    base += "<geometry><sphere><radius>0.05</radius></sphere></geometry><surface><friction><ode><mu>0</mu><mu2>0</mu2>"
    base += "</ode></friction></surface></collision></link>"
    joints = "<left_joint>l</left_joint><right_joint>r</right_joint>"
    plugin = f'<plugin name="p" filename="libDiffDrivePlugin.so">{joints}</plugin>'
    sim = load(tmp_path, base + wheels((("l", 0, 0.2), ("r", 0, -0.2))) + plugin, ground=True)

    command(sim, 0.5, 0.0)
    sim.run(2.0)
    assert sim["m"].link("base").twist.linear[0] == pytest.approx(0.5, rel=0.02)
    command(sim, 0.0, 0.5)
    sim.run(2.0)
    assert sim["m"].link("base").twist.angular[2] == pytest.approx(-0.5, rel=0.05)


def test_skid_steer_drives_all_four_wheels(tmp_path: Path) -> None:
    base = f'<link name="base"><pose>0 0 0.1 0 0 0</pose>{BODY.format(5)}</link>'
    four = (("left_front", 0.2, 0.2), ("left_rear", -0.2, 0.2), ("fr", 0.2, -0.2), ("right_rear", -0.2, -0.2))
    plugin = '<plugin name="p" filename="libSkidSteerDrivePlugin.so"><right_front>fr</right_front></plugin>'
    sim = load(tmp_path, base + wheels(four) + plugin, ground=True)

    command(sim, 0.3, 0.0)
    sim.run(2.0)

    assert sim["m"].link("base").twist.linear[0] == pytest.approx(0.3, rel=0.02)
    command(sim, 0.0, 0.3)
    sim.run(1.0)
    assert sim["m"].link("base").twist.angular[2] > 0.1


def test_a_bounding_box_contains_all_rotated_collisions() -> None:
    from trundle.base.diagnostics import Source
    from trundle.robots.model import Collision
    from trundle.spatial import Pose

    at = Source("x")
    lying = Pose.from_rpy(0, 0, 0, math.pi / 2, 0, 0)
    link = Link(
        name="l",
        at=at,
        collisions=(
            Collision(name="a", at=at, geometry=Cylinder(0.5, 2.0), link_from_collision=lying),
            Collision(name="b", at=at, geometry=Box((0.1, 0.1, 0.1)), link_from_collision=Pose((1.0, 0.0, 0.0))),
        ),
    )
    assert bounding_box(link) == pytest.approx((1.55, 2.0, 1.0))
