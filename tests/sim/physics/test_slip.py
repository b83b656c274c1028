"""Contacts that give distance to a force: slip1 and slip2 of two surfaces, by m dv/dt = F − v / slip.

Gazebo's law (ODEPhysics::Collide): the slips of both collisions add up, and all contact points of the two together slip
as one would.
"""

import math
from collections.abc import Callable
from pathlib import Path

import pytest

import trundle
from trundle.sim.simulation import Simulation
from trundle.spatial import Wrench

Load = Callable[..., Simulation]
MASS, FORCE = 0.2, 3.0
"""[kg], [N]"""
PLANE = "<plane><normal>0 0 1</normal></plane>"
BOX = "<box><size>0.1 0.1 0.1</size></box>"
BALL = "<sphere><radius>0.05</radius></sphere>"
CYLINDER = "<cylinder><radius>0.05</radius><length>0.1</length></cylinder>"


def collision(shape: str, slip: str = "", *, name: str = "c", pose: str = "0 0 0 0 0 0", mu: float = 1000.0) -> str:
    surface = f"<surface><friction><ode><mu>{mu}</mu><mu2>{mu}</mu2>{slip}</ode></friction></surface>"
    return f'<collision name="{name}"><pose>{pose}</pose><geometry>{shape}</geometry>{surface}</collision>'


def slips(slip1: float, slip2: float | None = None) -> str:
    return f"<slip1>{slip1}</slip1><slip2>{slip1 if slip2 is None else slip2}</slip2>"


def body(collisions: str, *, pose: str = "0 0 0.05 0 0 0", mass: float = MASS, name: str = "b") -> str:
    """Body with large inertia, which hardly turns."""
    moments = "".join(f"<{m}>10000</{m}>" for m in ("ixx", "iyy", "izz"))
    inertial = f"<inertial><mass>{mass}</mass><inertia>{moments}</inertia></inertial>"
    return f'<model name="{name}"><pose>{pose}</pose><link name="l">{inertial}{collisions}</link></model>'


@pytest.fixture
def load(tmp_path: Path) -> Load:
    """Load models on a floor, at rest."""

    def load(*models: str, floor: str = "", gravity: str = "0 0 -9.8") -> Simulation:
        ground = f'<model name="floor"><static>true</static><link name="l">{collision(PLANE, floor)}</link></model>'
        file = tmp_path / "w.sdf"
        file.write_text(
            f'<sdf version="1.7"><world name="w"><gravity>{gravity}</gravity>{ground}{"".join(models)}</world></sdf>'
        )
        sim = trundle.load(str(file))
        assert sim.report.warnings == []
        sim.run(0.3)
        return sim

    return load


def distance(sim: Simulation, force: tuple[float, float], *, seconds: float = 2.0) -> tuple[float, float]:
    """Distance of the body under a force [m]."""
    x, y, _ = sim["b"].pose.position
    sim["b"].link("l").apply_wrench(Wrench(force=(*force, 0.0)))
    sim.run(seconds)
    after = sim["b"].pose.position
    return after[0] - x, after[1] - y


def exact(slip: float, force: float = FORCE, *, seconds: float = 2.0) -> float:
    delay = MASS * slip
    return force * slip * (seconds - delay * (1 - math.exp(-seconds / delay)))


@pytest.mark.parametrize(
    ("shape", "pose"),
    [
        (BOX, "0 0 0.05 0 0 0"),
        (BALL, "0 0 0.05 0 0 0"),
        (CYLINDER, "0 0 0.05 0 0 0"),
        (CYLINDER, f"0 0 0.05 {math.pi / 2} 0 0"),
    ],
)
@pytest.mark.parametrize("slip", [0.1, 0.01, 0.001])
def test_a_force_makes_a_body_of_any_shape_slip(load: Load, slip: float, shape: str, pose: str) -> None:
    """Gazebo 11 moves 0.594 m for 0.1 m/s/N; the last slip is a fifth of the velocity change by the force in a step."""
    sim = load(body(collision(shape, slips(slip)), pose=pose))

    assert distance(sim, (FORCE, 0.0)) == pytest.approx((exact(slip), 0.0), rel=6e-3, abs=1e-6)


def test_the_slips_of_two_surfaces_add_up(load: Load) -> None:
    sim = load(body(collision(BOX, slips(0.06))), floor=slips(0.04))

    assert distance(sim, (FORCE, 0.0))[0] == pytest.approx(exact(0.1), rel=2e-3)


@pytest.mark.parametrize(("first", "along"), [("", "y"), ("<fdir1>1 0 0</fdir1>", "x"), ("<fdir1>0 1 0</fdir1>", "y")])
def test_slip1_is_along_the_first_direction_and_slip2_across_it(load: Load, first: str, along: str) -> None:
    """ODE's first direction on a level floor is y where the file names none."""
    sim = load(body(collision(BOX, slips(0.1, 0.02) + first)))

    x, y = (exact(0.1), exact(0.02)) if along == "x" else (exact(0.02), exact(0.1))
    assert distance(sim, (FORCE, FORCE)) == pytest.approx((x, y), rel=2e-3)


@pytest.mark.parametrize("first", ["1 0 0", "0 1 0"])
def test_a_body_that_slips_in_one_direction_holds_in_the_other(load: Load, first: str) -> None:
    sim = load(body(collision(BOX, slips(0.1, 0.0) + f"<fdir1>{first}</fdir1>")))

    x, y = (exact(0.1), 0.0) if first == "1 0 0" else (0.0, exact(0.1))
    assert distance(sim, (FORCE, FORCE)) == pytest.approx((x, y), rel=2e-3, abs=1e-4)


def test_each_collision_of_a_link_slips_separately(load: Load) -> None:
    """As in Gazebo's test SphereSlip: two balls halve the slip."""
    balls = "".join(
        collision(BALL, slips(0.1), name=name, pose=f"0 {y} 0 0 0 0") for name, y in (("l", 0.1), ("r", -0.1))
    )
    sim = load(body(balls))

    assert distance(sim, (FORCE, 0.0))[0] == pytest.approx(exact(0.05), rel=2e-3)


@pytest.mark.parametrize("shape", [BOX, BALL])
def test_slipping_contacts_report_their_friction_force(load: Load, shape: str) -> None:
    sim = load(body(collision(shape, slips(0.01))))
    distance(sim, (FORCE, 0.0), seconds=0.5)
    forces = [contact.force.force for contact in sim.contacts()]
    away = 1.0 if sim.contacts()[0].collisions[0].startswith("floor") else -1.0
    assert sum(force[0] for force in forces) * away == pytest.approx(-FORCE, rel=2e-3)
    assert sum(force[2] for force in forces) * away == pytest.approx(MASS * 9.8, rel=1e-3)


def test_a_joint_above_a_slipping_body_measures_the_transmitted_force(load: Load) -> None:
    inertial = "<inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial>"
    foot = f'<link name="foot"><pose>0 0 0.05 0 0 0</pose>{inertial}{collision(BOX, slips(0.01))}</link>'
    joint = '<joint name="j" type="revolute"><parent>foot</parent><child>l</child><axis><xyz>0 0 1</xyz></axis></joint>'
    sim = load(f'<model name="b">{foot}<link name="l"><pose>0 0 0.06 0 0 0</pose>{inertial}</link>{joint}</model>')
    assert distance(sim, (FORCE, 0.0), seconds=0.5)[0] > 0.01
    assert sim["b"].joint("j").reaction.force == pytest.approx((-FORCE, 0.0, 9.8), rel=5e-3, abs=1e-3)


def test_slip_does_not_keep_a_body_from_sliding(load: Load) -> None:
    """Beyond friction of 0.5 it speeds up."""
    sim = load(body(collision(BOX, slips(0.01), mu=0.5)))
    friction_force = 0.5 * MASS * 9.8

    assert distance(sim, (friction_force + 1.0, 0.0), seconds=1.0)[0] == pytest.approx(1.0 / MASS / 2, rel=0.01)


def test_a_body_slips_equally_among_many_shapes(load: Load) -> None:
    """So many that shapes meet by MuJoCo's own search."""
    walls = [
        f'<model name="w{i}"><static>true</static><pose>{9 + i} 9 9 0 0 0</pose><link name="l">{collision(BOX)}</link>'
        "</model>"
        for i in range(45)
    ]
    others = [body(collision(BOX), name=f"o{i}", pose=f"{9 + i} -9 0.05 0 0 0") for i in range(45)]
    sim = load(body(collision(BOX, slips(0.1))), *walls, *others)

    assert distance(sim, (FORCE, 0.0), seconds=0.5)[0] == pytest.approx(exact(0.1, seconds=0.5), rel=5e-3)


def test_saved_states_continue_slipping_equally(load: Load) -> None:
    sim = load(body(collision(BOX, slips(0.002))))
    distance(sim, (FORCE, 0.0), seconds=0.005)
    saved = sim.save()
    ends: list[tuple[float, ...]] = []
    for _ in range(2):
        sim.restore(saved)
        sim.run(0.1)
        ends.append(sim["b"].pose.position)
    assert ends[0] == ends[1]
