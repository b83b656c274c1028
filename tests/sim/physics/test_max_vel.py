"""What yields and may correct depth slowly only (Gazebo's default) rests as deep as in Gazebo, and does not hop."""

import math
from collections.abc import Callable
from pathlib import Path

import pytest
from tests.sim.physics.ode_contact import ode_heights, ode_rest_depth

import trundle
from trundle.sim.simulation import Simulation

Load = Callable[..., Simulation]
FLOOR = """<model name="floor"><static>true</static><link name="l"><collision name="c"><geometry><plane><normal>0 0 1
</normal></plane></geometry></collision></link></model>"""
BALL = "<sphere><radius>0.1</radius></sphere>"
SHAPES = {
    "ball": BALL,
    "box": "<box><size>0.4 0.4 0.2</size></box>",
    "disc": "<cylinder><radius>0.2</radius><length>0.2</length></cylinder>",
    "mesh": "<mesh><uri>body.obj</uri></mesh>",
}
CORNERS = [(x, y, z) for z in (-0.1, 0.1) for x, y in ((0.2, 0.0), (0.0, 0.2), (-0.2, 0.0), (0.0, -0.2))]
FACES = "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"


def surface(**ode: float) -> str:
    """The contact of a surface."""
    inside = "".join(f"<{name}>{value}</{name}>" for name, value in ode.items())
    return f"<surface><contact><ode>{inside}</ode></contact></surface>"


def balls(count: int, contact: str) -> str:
    """Balls around a circle."""
    centers = [(0.2 * math.cos(i * math.tau / count), 0.2 * math.sin(i * math.tau / count)) for i in range(count)]
    return "".join(
        f'<collision name="c{i}"><pose>{x} {y} 0 0 0 0</pose><geometry>{BALL}</geometry>{contact}</collision>'
        for i, (x, y) in enumerate(centers)
    )


@pytest.fixture
def load(tmp_path: Path) -> Load:
    """Load a body of shapes that reach 0.1 m down, above a floor."""

    def load(collisions: str, *, mass: float, drop: float, h: float = 1e-3) -> Simulation:
        (tmp_path / "body.obj").write_text("".join(f"v {x} {y} {z}\n" for x, y, z in CORNERS) + FACES)
        moments = "".join(f"<{m}>{0.02 * mass}</{m}>" for m in ("ixx", "iyy", "izz"))
        inertial = f"<inertial><mass>{mass}</mass><inertia>{moments}</inertia></inertial>"
        model = (
            f'<model name="b"><pose>0 0 {0.1 + drop} 0 0 0</pose><link name="l">{inertial}{collisions}</link></model>'
        )
        physics = f'<gravity>0 0 -9.8</gravity><physics type="ode"><max_step_size>{h}</max_step_size></physics>'
        file = tmp_path / "w.world"
        file.write_text(f'<sdf version="1.6"><world name="w">{physics}{FLOOR}{model}</world></sdf>')
        return trundle.load(str(file))

    return load


def heights(sim: Simulation, seconds: float, h: float = 1e-3) -> list[float]:
    """Heights above the floor after each step [m]."""
    values: list[float] = []
    for _ in range(round(seconds / h)):
        sim.step()
        values.append(sim["b"].pose.position[2] - 0.1)
    return values


# Before, the first rose by 22 mm from the floor and rested 0.2 mm deep; Gazebo's rule has 3.0 mm.
@pytest.mark.parametrize(
    ("shape", "mass", "kp", "kd", "drop", "h"),
    [
        (5, 6.2, 5.9e4, 25.0, 0.03, 1e-3),
        ("box", 6.2, 5.9e4, 25.0, 0.03, 1e-3),
        ("ball", 0.5, 1e4, 1.0, 0.05, 1e-3),
        ("ball", 0.5, 1e7, 1.0, 0.05, 5e-3),
        ("ball", 50.0, 1e7, 1.0, 0.05, 5e-4),
        ("box", 5.0, 1e6, 100.0, 0.05, 1e-3),
        ("box", 20.0, 1e5, 1e3, 0.005, 2e-3),
        ("disc", 3.0, 1e5, 10.0, 0.02, 1e-3),
        ("mesh", 8.0, 3e5, 50.0, 0.03, 1e-3),
        ("mesh", 2.0, 3e4, 300.0, 0.0, 5e-3),
        (8, 50.0, 1e6, 1e3, 0.02, 5e-3),
        (8, 50.0, 1e5, 1e4, 0.05, 1e-3),
        (3, 50.0, 1e6, 1.0, 0.05, 5e-4),
        (6, 2.0, 1e7, 1e4, 0.0, 1e-3),
    ],
)
def test_a_body_on_contact_springs_rises_to_its_depth_at_rest_and_no_further(
    load: Load, shape: str | int, mass: float, kp: float, kd: float, drop: float, h: float
) -> None:
    contact = surface(kp=kp, kd=kd)
    collisions = (
        balls(shape, contact)
        if isinstance(shape, int)
        else f'<collision name="c"><geometry>{SHAPES[shape]}</geometry>{contact}</collision>'
    )
    sim = load(collisions, mass=mass, drop=drop, h=h)
    measured = heights(sim, 1.5, h)

    # SDF's own kd, the floor's, is 1.
    points = len(sim.contacts())
    exact = ode_heights(mass, points, kp=kp, kd=kd + 1.0, drop=drop, h=h, seconds=1.5)
    assert measured[-1] == pytest.approx(exact[-1], rel=0.2, abs=1e-4)
    assert max(measured[measured.index(min(measured)) :]) < measured[-1] + 1e-3
    assert max(map(abs, sim["b"].pose.rpy)) < 1e-3


@pytest.mark.parametrize(("kp", "kd", "mass"), [(5.9e4, 25.0, 6.2), (1e6, 1.0, 10.0), (2e5, 200.0, 30.0)])
@pytest.mark.parametrize("max_vel", [0.01, 0.1, 100.0])
@pytest.mark.parametrize("min_depth", [0.0, 0.003])
def test_the_depth_at_rest_follows_odes_rule(
    load: Load, kp: float, kd: float, mass: float, max_vel: float, min_depth: float
) -> None:
    rule = {"kp": kp, "kd": kd + 1.0, "max_vel": max_vel}
    contact = surface(kp=kp, kd=kd, max_vel=max_vel, min_depth=min_depth)
    sim = load(balls(5, contact), mass=mass, drop=0.001)
    sim.run(3.0)

    depth = min_depth + ode_rest_depth(mass * 9.8 / 5, **rule)
    assert -ode_heights(mass, 5, **rule, min_depth=min_depth, drop=0.001, seconds=3.0)[-1] == pytest.approx(depth)
    assert 0.1 - sim["b"].pose.position[2] == pytest.approx(depth, rel=0.02, abs=5e-5)
    assert math.hypot(*sim["b"].links[0].twist.linear) < 1e-4


def test_a_higher_max_vel_makes_a_body_hop_higher(load: Load) -> None:
    """With 1 m/s 6.3 mm in Gazebo, by its rule."""
    tops: list[float] = []
    for max_vel in (0.01, 0.1, 1.0):
        measured = heights(load(balls(5, surface(kp=5.9e4, kd=25.0, max_vel=max_vel)), mass=6.2, drop=0.03), 0.5)
        tops.append(max(measured[measured.index(min(measured)) :]))
    assert tops == sorted(tops)
    assert tops[1] < 0.0
    assert tops[2] == pytest.approx(0.0063, rel=0.5)
