"""Statically indeterminate loads, and soft contacts, against springs and dampers."""

from collections.abc import Callable
from pathlib import Path

import pytest
from tests.sim.physics.quasistatic import GRAVITY, Vehicle

import trundle
from trundle.sim.simulation import Simulation

Load = Callable[..., Simulation]
FLOOR = """<model name="floor"><static>true</static><link name="l"><collision name="c"><geometry><plane><normal>0 0 1
</normal></plane></geometry></collision></link></model>"""
BOX = "<box><size>0.3 0.3 0.2</size></box>"
BALL = "<sphere><radius>0.1</radius></sphere>"


@pytest.fixture
def load(tmp_path: Path) -> Load:
    """Load models on a floor."""

    def load(*models: str, gravity: float = GRAVITY) -> Simulation:
        file = tmp_path / "w.world"
        inside = f"<gravity>0 0 {-gravity}</gravity>{FLOOR}{''.join(models)}"
        file.write_text(f'<sdf version="1.6"><world name="w">{inside}</world></sdf>')
        return trundle.load(str(file))

    return load


def loads(sim: Simulation) -> dict[str, float]:
    """Normal force of the floor on each collision of another model [N], by link and collision."""
    forces: dict[str, float] = {}
    for contact in sim.contacts():
        (name,) = (collision for collision in contact.collisions if not collision.startswith("floor"))
        part = name.split("::", 1)[1]
        forces[part] = forces.get(part, 0.0) + abs(contact.force.force[2])
    return forces


@pytest.mark.parametrize(
    "vehicle",
    [
        Vehicle(wheels=((0, 0.15), (0, -0.15)), balls=((0.15, 0), (-0.15, 0))),
        Vehicle(wheels=((0, 0.15), (0, -0.15)), balls=((0.15, 0), (-0.15, 0)), wheel_mass=0.2, mass=3.0, x=0.03),
        Vehicle(wheels=((0.1, 0.2), (0.1, -0.2)), balls=((-0.15, 0.1), (-0.15, -0.1), (0.2, 0)), x=-0.02),
        Vehicle(wheels=((0.2, 0.2), (-0.2, 0.2), (0.2, -0.2), (-0.2, -0.2), (0, 0.2), (0, -0.2)), x=0.05),
    ],
)
def test_every_contact_point_is_equally_soft_and_a_wheel_counts_as_two(load: Load, vehicle: Vehicle) -> None:
    sim = load(vehicle.sdf())
    sim.run(0.5)

    forces = loads(sim)
    names = [f"wheel{i}::tyre" for i in range(len(vehicle.wheels))]
    names += [f"chassis::ball{i}" for i in range(len(vehicle.balls))]
    assert forces == pytest.approx(
        {name: point.load for name, point in zip(names, vehicle.points(), strict=True)}, rel=0.02
    )


def dropped(shape: str, mass: float, kp: float, kd: float, height: float) -> str:
    # With Gazebo's default of max_vel a spring has no recoil: tests/sim/physics/test_max_vel.py.
    contact = f"<contact><ode><kp>{kp}</kp><kd>{kd}</kd><max_vel>100</max_vel></ode></contact>"
    moments = "".join(f"<{m}>{0.01 * mass}</{m}>" for m in ("ixx", "iyy", "izz"))
    inertial = f"<inertial><mass>{mass}</mass><inertia>{moments}</inertia></inertial>"
    shaped = f'<collision name="c"><geometry>{shape}</geometry><surface>{contact}</surface></collision>'
    return f'<model name="b"><pose>0 0 {0.1 + height} 0 0 0</pose><link name="l">{inertial}{shaped}</link></model>'


def bounce(mass: float, stiffness: float, damping: float, height: float) -> tuple[float, float]:
    """Lowest height of a mass that falls on a spring with damper, and the highest within a second after it [m]."""
    z, v, dt, heights = height, 0.0, 1e-5, [height]
    for _ in range(100_000):
        push = max(-stiffness * z - damping * v, 0.0) if z < 0.0 else 0.0
        v += dt * (push / mass - GRAVITY)
        z += dt * v
        heights.append(z)
    return extremes(heights)


def extremes(heights: list[float]) -> tuple[float, float]:
    """The lowest, and the highest after it."""
    deepest = min(heights)
    return deepest, max(heights[heights.index(deepest) :])


# Gazebo: the first goes down to 0.0711 and returns to 0.0974 m; exact 0.0703 and 0.0985.
@pytest.mark.parametrize(
    ("shape", "points", "mass", "kp", "kd", "height"),
    [
        (BOX, 4, 5.0, 2000.0, 50.0, 0.2),
        (BOX, 4, 2.0, 5000.0, 5.0, 0.1),
        (BALL, 1, 1.0, 2000.0, 50.0, 0.2),
        (BALL, 1, 1.0, 5000.0, 5.0, 0.2),
        (BALL, 1, 10.0, 20000.0, 100.0, 0.2),
        (BOX, 4, 5.0, 3e4, 20.0, 0.2),
        (BOX, 4, 5.0, 1e4, 0.0, 0.2),
        (BALL, 1, 5.0, 3e4, 0.0, 0.2),
    ],
)
def test_soft_contacts_are_parallel_springs_and_dampers(
    load: Load, shape: str, points: int, mass: float, kp: float, kd: float, height: float
) -> None:
    sim = load(dropped(shape, mass, kp, kd, height))
    heights: list[float] = []
    for _ in range(1000):
        sim.step()
        heights.append(sim["b"].pose.position[2] - 0.1)
    deepest, highest = extremes(heights)

    # SDF's own kd, the floor's, is 1.
    deep, high = bounce(mass, points * kp, points * (kd + 1.0), height)
    assert deepest == pytest.approx(deep, rel=0.05)
    assert highest == pytest.approx(high, rel=0.05, abs=1e-3)
    if kd == 0.0:  # the floor's own 1 N·s/m takes minutes
        return
    sim.run(6.0)
    assert sim["b"].pose.position[2] - 0.1 == pytest.approx(-mass * GRAVITY / (points * kp), rel=0.02, abs=1e-4)


def test_a_link_that_only_turns_is_not_held_by_the_ground_it_grazes(load: Load) -> None:
    """An arm's first link in the ground by a rounding error: it cannot give way, and its contact must not be hard."""
    sim = load(
        f"""<model name="arm"><pose>0 0 {0.1 - 1e-9} 0 0 0</pose>
        <link name="base"><inertial><mass>1</mass></inertial></link>
        <link name="turn"><inertial><mass>0.3</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia>
        </inertial><collision name="c"><geometry>{BOX}</geometry></collision></link>
        <joint name="fixed" type="fixed"><parent>world</parent><child>base</child></joint>
        <joint name="z" type="revolute"><parent>base</parent><child>turn</child><axis><xyz>0 0 1</xyz></axis></joint>
        </model>"""
    )
    joint = sim["arm"].joint("z")
    for _ in range(500):
        joint.command_effort(0.1)
        sim.step()

    assert sim.contacts()
    assert loads(sim)["turn::c"] < 0.1
    assert joint.position == pytest.approx(0.5 * 0.1 / 0.01 * 0.5**2, rel=0.02)
