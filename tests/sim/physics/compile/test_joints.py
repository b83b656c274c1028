"""Every type of joint, from the file to the motion, against mechanics."""

import json
import math
from collections.abc import Callable
from pathlib import Path

import pytest

import trundle
from trundle.app.cli.main import main
from trundle.base.diagnostics import DescriptionError
from trundle.sim.simulation import Simulation
from trundle.spatial import Wrench

G = 9.8
Load = Callable[..., Simulation]


def link(name: str, *, pose: str = "0 0 0 0 0 0", mass: float = 1.0, inertia: float = 0.01, com: str = "0 0 0") -> str:
    moments = "".join(f"<{m}>{inertia}</{m}>" for m in ("ixx", "iyy", "izz"))
    zeros = "<ixy>0</ixy><ixz>0</ixz><iyz>0</iyz>"
    return (
        f'<link name="{name}"><pose>{pose}</pose><inertial><pose>{com} 0 0 0</pose><mass>{mass}</mass>'
        f"<inertia>{moments}{zeros}</inertia></inertial></link>"
    )


def joint(name: str, kind: str, parent: str, child: str, inside: str = "", *, pose: str = "0 0 0 0 0 0") -> str:
    return (
        f'<joint name="{name}" type="{kind}"><pose>{pose}</pose><parent>{parent}</parent><child>{child}</child>'
        f"{inside}</joint>"
    )


def axis(xyz: str, inside: str = "", *, tag: str = "axis") -> str:
    return f"<{tag}><xyz>{xyz}</xyz>{inside}</{tag}>"


@pytest.fixture
def load(tmp_path: Path) -> Load:
    """Load one model named m in a world without a floor."""

    def load(*parts: str, version: str = "1.6", gravity: float = G, after: str = "") -> Simulation:
        return trundle.load(str(write(tmp_path, *parts, version=version, gravity=gravity, after=after)))

    return load


def write(folder: Path, *parts: str, version: str = "1.6", gravity: float = G, after: str = "") -> Path:
    file = folder / "w.world"
    file.write_text(
        f'<sdf version="{version}"><world name="w"><gravity>0 0 {-gravity}</gravity>'
        f'<model name="m">{"".join(parts)}</model>{after}</world></sdf>'
    )
    return file


def test_a_ball_joint_swings_and_turns_about_all_axes(load: Load) -> None:
    sim = load(link("bob", com="0 0 -1"), joint("j", "ball", "world", "bob"))
    j = sim["m"].joint("j")
    assert len(j.axes) == 3
    # A torque about x alone, then about y, against the rotation vector.
    j.command_effort(0.5, axis=0)
    sim.run(0.05)
    assert j.positions == pytest.approx((0.5 / 1.01 * 0.05**2 / 2, 0.0, 0.0), rel=0.03, abs=1e-9)
    assert sim["m"].link("bob").pose.position == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)
    j.command_effort(0.0, axis=0)
    j.command_effort(-0.5, axis=1)
    sim.run(0.05)
    assert j.positions[1] == pytest.approx(-0.5 / 1.01 * 0.05**2 / 2, rel=0.05)


@pytest.mark.parametrize("kind", ["universal", "revolute2"])
def test_two_hinges_turn_one_after_the_other(load: Load, kind: str) -> None:
    axes = axis("0 0 1") + axis("0 1 0", tag="axis2")
    sim = load(link("a"), joint("j", kind, "world", "a", axes), gravity=0.0)
    j = sim["m"].joint("j")
    j.set_position(math.pi / 2, axis=0)
    j.set_position(0.3, axis=1)
    assert j.positions == pytest.approx((math.pi / 2, 0.3))
    # First the outer one about z, then the inner about what was y and is now −x.
    assert sim["m"].link("a").pose.transform_vector((0.0, 0.0, 1.0)) == pytest.approx(
        (0.0, math.sin(0.3), math.cos(0.3)), abs=1e-9
    )
    j.command_effort(0.02, axis=1)
    sim.run(0.1)
    assert j.velocities == pytest.approx((0.0, 0.02 / 0.01 * 0.1), rel=1e-6, abs=1e-9)
    assert j.efforts == pytest.approx((0.0, 0.02))


@pytest.mark.parametrize(
    ("version", "tag", "metres_a_turn"),
    [
        ("1.6", "<thread_pitch>-12.566370614</thread_pitch>", 0.5),
        ("1.10", "<screw_thread_pitch>0.5</screw_thread_pitch>", 0.5),
    ],
)
def test_a_screw_advances_by_its_thread_pitch(load: Load, version: str, tag: str, metres_a_turn: float) -> None:
    sim = load(link("nut"), joint("j", "screw", "world", "nut", axis("0 0 1") + tag), version=version)
    sim.run(0.5)
    nut, j = sim["m"].link("nut"), sim["m"].joint("j")
    lead = metres_a_turn / (2 * math.pi)
    falling = G / (1 + 0.01 / lead**2)
    assert nut.pose.position[2] == pytest.approx(-falling * 0.5**2 / 2, rel=5e-3)
    # A right-hand thread that sinks turns to the right, seen from above.
    assert j.position == pytest.approx(nut.pose.position[2] / lead, rel=1e-4)
    assert j.position < 0.0


@pytest.mark.parametrize("nested", [False, True])
@pytest.mark.parametrize("turned", [False, True])
def test_gears_mesh_by_their_ratio(load: Load, nested: bool, turned: bool) -> None:
    # Turned: the large wheel is the parent of the base, and its joint has the base's rotation relative to it.
    ends = ("large", "base") if turned else ("base", "large")
    gears = (
        link("base"),
        link("small", pose="1 0 0 0 0 0"),
        link("large", pose="2 0 0 0 0 0", inertia=0.04),
        joint("js", "revolute", "base", "small", axis("0 0 1")),
        joint("jl", "revolute", *ends, axis("0 0 1"), pose="2 0 0 0 0 0" if turned else "0 0 0 0 0 0"),
        joint(
            "mesh",
            "gearbox",
            "small",
            "large",
            axis("0 0 1")
            + axis("0 0 1", tag="axis2")
            + "<gearbox_ratio>0.5</gearbox_ratio><gearbox_reference_body>base</gearbox_reference_body>",
        ),
        joint("post", "fixed", "world", "base"),
    )
    sim = load('<model name="n">', *gears, "</model>", gravity=0.0) if nested else load(*gears, gravity=0.0)
    prefix = "n::" if nested else ""
    small, large = sim["m"].joint(f"{prefix}js"), sim["m"].joint(f"{prefix}jl")
    small.command_effort(0.1)
    sim.run(1.0)
    assert sim["m"].link(f"{prefix}large").twist.angular[2] == pytest.approx(-0.5 * small.velocity, rel=1e-3)
    assert large.position == pytest.approx((0.5 if turned else -0.5) * small.position, rel=1e-4)
    assert small.velocity == pytest.approx(0.1 / (0.01 + 0.25 * 0.04), rel=1e-3)


def test_a_mimic_follows_its_leader(load: Load) -> None:
    mimic = '<mimic joint="lead"><multiplier>-2</multiplier><offset>0.1</offset><reference>0.05</reference></mimic>'
    sim = load(
        link("a"),
        link("b", pose="1 0 0 0 0 0"),
        joint("lead", "revolute", "world", "a", axis("0 0 1")),
        joint("follow", "revolute", "world", "b", axis("0 0 1", mimic)),
        version="1.11",
        gravity=0.0,
    )
    lead, follow = sim["m"].joint("lead"), sim["m"].joint("follow")
    lead.set_position(0.3)
    assert follow.position == pytest.approx(-2 * (0.3 - 0.05) + 0.1)
    sim.run(0.1)
    assert lead.position == pytest.approx(0.3, abs=1e-4)
    lead.command_effort(0.05)
    sim.run(1.0)
    assert lead.velocity == pytest.approx(0.05 / (0.01 + 4 * 0.01), rel=1e-2)
    assert follow.position == pytest.approx(-2 * (lead.position - 0.05) + 0.1, abs=1e-4)


GRIPPER = """<robot name="r"><link name="world"/><link name="a">{0}</link><link name="b">{0}</link>
<joint name="lead" type="continuous"><parent link="world"/><child link="a"/><axis xyz="0 0 1"/></joint>
<joint name="follow" type="revolute"><parent link="world"/><child link="b"/><axis xyz="0 0 1"/>
<limit lower="0" upper="0" effort="1" velocity="1"/><mimic joint="lead" multiplier="-2" offset="0.1"/></joint>
{1}</robot>"""
URDF_INERTIA = (
    '<inertial><mass value="1"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>'
)
MIMIC_PLUGIN = "<gazebo><plugin name='p' filename='libx.so'><mimicJoint> {} </mimicJoint></plugin></gazebo>"


@pytest.mark.parametrize(
    ("plugin", "follows"), [("", True), (MIMIC_PLUGIN.format("lead"), True), (MIMIC_PLUGIN.format("follow"), False)]
)
def test_a_urdf_mimic_follows_unless_a_plugin_drives_it(tmp_path: Path, plugin: str, follows: bool) -> None:
    """A joint that a plugin drives would be driven twice, with different parameters."""
    file = tmp_path / "x.urdf"
    file.write_text(GRIPPER.format(URDF_INERTIA, plugin))
    sim = trundle.load(str(file))
    lead = sim["r"].joint("lead")
    lead.command_velocity(0.5)
    sim.run(1.0)
    assert lead.position == pytest.approx(0.5, rel=0.01)
    if follows:
        assert sim["r"].joint("follow").position == pytest.approx(-2 * lead.position + 0.1, abs=1e-3)
    else:
        assert not sim["r"].joint("follow").is_driven


SLED = """<robot name="r"><link name="world"/><link name="a">{0}</link>
<joint name="j" type="planar"><parent link="world"/><child link="a"/><origin rpy="{1} 0 0"/><axis xyz="0 0 1"/></joint>
</robot>"""


def test_a_planar_joint_slides_along_two_axes_and_turns_in_its_plane(tmp_path: Path) -> None:
    tilt = 0.3
    file = tmp_path / "x.urdf"
    file.write_text(SLED.format(URDF_INERTIA, tilt))
    sim = trundle.load(str(file))
    sled = sim["r"].link("a")
    sled.apply_wrench(Wrench(force=(2.0, 0.0, 0.0), torque=(0.0, -0.03 * math.sin(tilt), 0.03 * math.cos(tilt))))
    sim.run(1.0)
    x, y, z = sled.pose.position
    assert x == pytest.approx(1.0, rel=2e-3)
    assert -y * math.cos(tilt) - z * math.sin(tilt) == pytest.approx(9.8 * math.sin(tilt) / 2, rel=2e-3)
    assert y * math.sin(tilt) == pytest.approx(z * math.cos(tilt), abs=1e-9)
    assert sled.pose.transform_vector((0.0, 0.0, 1.0)) == pytest.approx(
        (0.0, -math.sin(tilt), math.cos(tilt)), abs=1e-9
    )
    assert sled.twist.angular[2] == pytest.approx(3.0 * math.cos(tilt), rel=1e-6)
    assert len(sim["r"].joint("j").axes) == 3


def parallelogram(*, reverse: bool) -> list[str]:
    """Two rods of 1 m hang from the world 2 m apart; a bar joins their ends."""
    parts = [
        link("left", pose="0 0 0 0 0 0", com="0 0 -0.5"),
        link("right", pose="2 0 0 0 0 0", com="0 0 -0.5"),
        link("bar", pose="0 0 -1 0 0 0", com="1 0 0", mass=2.0),
        joint("l", "revolute", "world", "left", axis("0 1 0")),
        joint("r", "revolute", "world", "right", axis("0 1 0")),
        joint("lb", "revolute", "left", "bar", axis("0 1 0")),
    ]
    last = joint("rb", "revolute", "right", "bar", axis("0 1 0"), pose="2 0 0 0 0 0")
    return [*parts[:3], last, *parts[3:]] if reverse else [*parts, last]


@pytest.mark.parametrize("reverse", [False, True])
def test_a_loop_of_links_stays_closed_and_swings_as_one(load: Load, reverse: bool) -> None:
    sim = load(*parallelogram(reverse=reverse))
    left, right = sim["m"].joint("l"), sim["m"].joint("r")
    assert len(sim["m"].joint("rb").axes) == 1
    left.command_effort(2.0)
    sim.run(0.5)
    left.command_effort(0.0)
    crossings: list[float] = []
    before = left.position
    while len(crossings) < 4 and sim.time_ns < 10e9:
        sim.step()
        assert right.position == pytest.approx(left.position, abs=1e-3)
        if before < 0.0 <= left.position:
            crossings.append(sim.time_ns * 1e-9)
        before = left.position
    end = sim["m"].link("bar").pose.transform_point((2.0, 0.0, 0.0))
    assert end == pytest.approx(sim["m"].link("right").pose.transform_point((0.0, 0.0, -1.0)), abs=1e-3)
    # Both rods turn, the bar only moves: I = 2 (0.01 + 0.25) + 2, weight times arm = (2 · 0.5 + 2) g.
    small = 2 * math.pi * math.sqrt((2 * 0.26 + 2.0) / (3.0 * G))
    assert (crossings[-1] - crossings[0]) / 3 == pytest.approx(small, rel=0.02)
    assert sim["m"].joint("rb").position == pytest.approx(-right.position, abs=1e-3)


def test_a_link_welded_twice_holds(load: Load) -> None:
    sim = load(
        link("a", com="0.5 0 0"),
        joint("one", "fixed", "world", "a"),
        joint("two", "fixed", "world", "a"),
    )
    sim.run(1.0)
    assert sim["m"].link("a").pose.position == pytest.approx((0.0, 0.0, 0.0), abs=1e-6)


def test_a_joint_may_name_its_links_in_reverse(load: Load) -> None:
    # Both joints have the base as their child: one of them is turned.
    sim = load(
        link("one", pose="1 0 0 0 0 0"),
        link("two", pose="-1 0 0 0 0 0"),
        link("base", inertia=1000.0, mass=1000.0),
        joint("a", "revolute", "one", "base", axis("0 0 1"), pose="1 0 0 0 0 0"),
        joint("b", "revolute", "two", "base", axis("0 0 1"), pose="-1 0 0 0 0 0"),
        gravity=0.0,
    )
    assert sim.engine.compiled.model.nv == 6 + 2
    for name, wheel in (("a", "one"), ("b", "two")):
        sim["m"].joint(name).command_effort(0.01)
        sim.run(0.1)
        assert sim["m"].joint(name).velocity == pytest.approx(0.1, rel=1e-3)
        assert sim["m"].link(wheel).twist.angular[2] == pytest.approx(-0.1, rel=1e-3)
        sim["m"].joint(name).command_effort(0.0)


def test_a_joint_with_the_world_as_its_child_holds_its_parent(load: Load) -> None:
    sim = load(link("a", com="0 0 -1"), joint("j", "revolute", "a", "world", axis("0 1 0")))
    assert sim.engine.compiled.model.nv == 1
    sim.run(1.0)
    assert sim["m"].link("a").pose.position == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)


def test_a_joint_joins_two_models(load: Load) -> None:
    other = f'<model name="n"><pose>0 0 -1 0 0 0</pose>{link("b")}</model>'
    sim = load(
        link("a"),
        joint("post", "fixed", "world", "a"),
        version="1.10",
        after=other + joint("rope", "prismatic", "m::a", "n::b", axis("0 0 1", "<limit><lower>-0.5</lower></limit>")),
    )
    sim.run(2.0)
    assert sim["n"].link("b").pose.position[2] == pytest.approx(-1.5, abs=1e-3)
    assert sim.joints[0].position == pytest.approx(-0.5, abs=1e-3)


def test_a_spring_swings_about_its_reference(load: Load) -> None:
    dynamics = "<dynamics><spring_reference>0.2</spring_reference><spring_stiffness>0.04</spring_stiffness></dynamics>"
    sim = load(link("a"), joint("j", "revolute", "world", "a", axis("0 0 1", dynamics)), gravity=0.0)
    j = sim["m"].joint("j")
    half = math.pi * math.sqrt(0.01 / 0.04)
    sim.run(half)
    # Springs are integrated implicitly, which costs ω² h t / 2 = 0.3 % of the swing by now.
    assert j.position == pytest.approx(0.4, rel=5e-3)
    sim.run(half)
    assert j.position == pytest.approx(0.0, abs=5e-3)


def test_an_effort_is_clamped_and_ends_at_the_velocity_limit(load: Load) -> None:
    limits = "<limit><effort>0.1</effort><velocity>3</velocity></limit>"
    sim = load(link("a"), joint("j", "revolute", "world", "a", axis("0 0 1", limits)), gravity=0.0)
    j = sim["m"].joint("j")
    j.command_effort(50.0)
    sim.run(0.2)
    assert j.velocity == pytest.approx(0.1 / 0.01 * 0.2, rel=1e-6)
    assert j.effort == pytest.approx(0.1)
    sim.run(2.0)
    assert j.velocity == pytest.approx(3.0, rel=1e-3)
    # Beyond it nothing pushes, and nothing brakes.
    j.set_velocity(5.0)
    sim.run(0.5)
    assert j.velocity == pytest.approx(5.0, rel=1e-6)
    j.command_effort(-0.1)
    sim.run(0.1)
    assert j.velocity == pytest.approx(4.0, rel=1e-6)


def test_a_stop_is_hard_for_any_stiffness_as_in_ode(load: Load) -> None:
    limit = "<limit><lower>-0.2</lower><upper>0.2</upper><stiffness>60</stiffness><dissipation>8</dissipation></limit>"
    sim = load(link("a"), joint("j", "revolute", "world", "a", axis("0 0 1", limit)), gravity=0.0)
    j = sim["m"].joint("j")
    j.command_effort(3.0)
    sim.run(3.0)
    assert j.position == pytest.approx(0.2, abs=1e-4)
    message = "joint 'j': a limit's <stiffness> and <dissipation> are ignored, as in Gazebo's ODE; the stop is hard"
    assert sum(message in finding.what for finding in sim.report.findings) == 1


@pytest.mark.parametrize("kind", ["prismatic", "revolute"])
@pytest.mark.parametrize("speed", [0.3, 1.7, 4.3])
def test_a_joint_does_not_pass_its_stop(load: Load, kind: str, speed: float) -> None:
    """Gazebo passes it by 0.01 mm; a MuJoCo limit by a step's motion, 1.7 mm at 1.7 m/s."""
    limit = "<limit><lower>-1</lower><upper>0.05</upper></limit>"
    sim = load(link("a"), joint("j", kind, "world", "a", axis("1 0 0", limit)), gravity=0.0)
    j = sim["m"].joint("j")
    j.set_velocity(speed)
    furthest, fastest_back = 0.0, 0.0
    for _ in range(500):
        sim.step()
        furthest, fastest_back = max(furthest, j.position), min(fastest_back, j.velocity)
    assert 0.05 < furthest < 0.05 + 1e-7
    assert fastest_back > -0.005 * speed


def test_a_joint_reports_its_reaction(load: Load) -> None:
    sim = load(
        link("a", pose="0 0 1 0 0 0", mass=2.0),
        link("b", pose="0.5 0 1 0 0 0", com="0.3 0 0", mass=3.0),
        joint("wall", "fixed", "world", "a", pose="-0.2 0 0 0 0 0"),
        joint("arm", "fixed", "a", "b"),
    )
    sim.run(0.1)
    assert sim["m"].joint("arm").reaction.force == pytest.approx((0.0, 0.0, 3.0 * G), abs=1e-6)
    assert sim["m"].joint("arm").reaction.torque == pytest.approx((0.0, -0.3 * 3.0 * G, 0.0), abs=1e-6)
    wall = sim["m"].joint("wall").reaction
    assert wall.force == pytest.approx((0.0, 0.0, 5.0 * G), abs=1e-6)
    assert wall.torque == pytest.approx((0.0, -(0.2 * 2.0 + 1.0 * 3.0) * G, 0.0), abs=1e-6)


def test_a_reversed_joint_has_the_opposite_reaction(load: Load) -> None:
    joints = (joint("j", "revolute", "world", "a", axis("0 1 0")), joint("j", "revolute", "a", "world", axis("0 1 0")))
    for tag, sign in zip(joints, (1.0, -1.0), strict=True):
        sim = load(link("a", com="0 0 -1", mass=2.0), tag)
        sim.run(0.1)
        assert sim["m"].joint("j").reaction.force == pytest.approx((0.0, 0.0, sign * 2.0 * G), abs=1e-6)


def test_a_child_may_come_before_its_parent(load: Load) -> None:
    sim = load(
        link("tip", pose="2 0 0 0 0 0"),
        link("middle", pose="1 0 0 0 0 0"),
        link("root"),
        joint("b", "revolute", "middle", "tip", axis("0 0 1")),
        joint("a", "revolute", "root", "middle", axis("0 0 1")),
        joint("post", "fixed", "world", "root"),
    )
    sim["m"].joint("a").set_position(math.pi / 2)
    assert sim["m"].link("tip").pose.position == pytest.approx((1.0, 1.0, 0.0), abs=1e-9)


def test_two_parallel_axes_are_one_degree_of_freedom_with_a_warning(load: Load) -> None:
    axes = axis("0 0 1") + axis("0 0 -1", tag="axis2")
    sim = load(link("a"), joint("j", "universal", "world", "a", axes), gravity=0.0)
    assert any("'j': its two axes are parallel" in warning for warning in sim.report.warnings)
    sim["m"].joint("j").command_velocity(1.0)
    sim.run(0.5)
    assert sim["m"].joint("j").velocity == pytest.approx(1.0, rel=0.01)


@pytest.mark.parametrize("parameter", ["damping", "friction"])
def test_negative_damping_and_friction_become_zero_with_a_warning(load: Load, parameter: str) -> None:
    dynamics = f"<dynamics><{parameter}>-1</{parameter}></dynamics>"
    sim = load(link("a"), joint("j", "revolute", "world", "a", axis("0 0 1", dynamics)))
    assert any(f"'j': {parameter} -1 would add energy; physics uses 0" in w for w in sim.report.warnings)


def test_duplicate_names_are_refused_with_their_line(load: Load) -> None:
    with pytest.raises(DescriptionError, match="a second joint 'j'; names must differ"):
        load(link("a"), link("b"), *[joint("j", "ball", "world", child) for child in "ab"])


def test_the_command_writes_several_degrees_of_freedom_as_lists(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    axes = axis("0 0 1") + axis("0 1 0", tag="axis2")
    file = write(
        tmp_path,
        link("a"),
        link("b", pose="1 0 0 0 0 0"),
        link("c", pose="2 0 0 0 0 0"),
        joint("u", "universal", "world", "a", axes),
        joint("s", "ball", "world", "b"),
        joint("r", "revolute", "world", "c", axis("0 0 1")),
    )
    assert main(["run", str(file), "--headless", "--no-ros", "--speed", "max", "--duration", "0.1", "--json"]) == 0
    joints = json.loads(capsys.readouterr().out)["models"][0]["joints"]
    assert [(j["name"], j["position"]) for j in joints] == [("u", [0.0, 0.0]), ("s", [0.0, 0.0, 0.0]), ("r", 0.0)]
