"""Bodies that start inside another one are separated at once, at rest, and upright."""

import math
from collections.abc import Callable
from pathlib import Path

import pytest
from tests.sim.physics.ode_contact import ode_rest_depth
from tests.sim.physics.quasistatic import GRAVITY, Vehicle

import trundle
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose, Twist

Load = Callable[..., Simulation]
FLOOR = """<model name="floor"><static>true</static><link name="l"><collision name="c"><geometry><plane><normal>0 0 1
</normal></plane></geometry></collision></link></model>"""


@pytest.fixture
def load(tmp_path: Path) -> Load:
    """Load models on a floor."""

    def load(*models: str) -> Simulation:
        file = tmp_path / "w.world"
        inside = f"<gravity>0 0 {-GRAVITY}</gravity>{FLOOR}{''.join(models)}"
        file.write_text(f'<sdf version="1.6"><world name="w">{inside}</world></sdf>')
        return trundle.load(str(file))

    return load


def box(name: str, pose: str, *, mass: float = 1.0, surface: str = "") -> str:
    moments = "".join(f"<{m}>{0.03 * mass}</{m}>" for m in ("ixx", "iyy", "izz"))
    shape = "<geometry><box><size>0.4 0.4 0.4</size></box></geometry>"
    inertial = f"<inertial><mass>{mass}</mass><inertia>{moments}</inertia></inertial>"
    link = f'<link name="l">{inertial}<collision name="c">{shape}<surface>{surface}</surface></collision></link>'
    return f'<model name="{name}"><pose>{pose}</pose>{link}</model>'


def speed(sim: Simulation, name: str) -> float:
    twist = sim[name].links[0].twist
    return math.hypot(*twist.linear, *twist.angular)


# Gazebo is out within 10 ms.
@pytest.mark.parametrize("depth", [0.002, 0.05, 0.15])
@pytest.mark.parametrize("stiffness", [1e12, 1e5])
def test_a_box_that_starts_in_the_floor_is_separated_within_20_ms_at_rest(
    load: Load, depth: float, stiffness: float
) -> None:
    surface = f"<contact><ode><kp>{stiffness}</kp><kd>100</kd></ode></contact>"
    sim = load(box("b", f"0 0 {0.2 - depth} 0 0 0.3", surface=surface))
    for _ in range(2):
        sim.run(0.02)
        assert sim["b"].pose.position == pytest.approx((0, 0, 0.2), abs=2e-4)
        assert speed(sim, "b") < 0.02
        assert sim["b"].pose.rpy == pytest.approx((0, 0, 0.3), abs=1e-3)
        sim["b"].set_pose(Pose.from_rpy(0.0, 0.0, 0.2 - depth, 0.0, 0.0, 0.3))


def test_two_boxes_separate_by_their_masses_and_others_stay(load: Load) -> None:
    sim = load(box("light", "0 0 0.2 0 0 0"), box("heavy", "0.35 0 0.2 0 0 0", mass=4.0), box("far", "3 0 2 0 0 0"))
    sim["far"].set_twist(Twist((1.0, 0.0, 0.0)))
    sim.run(0.02)

    left, right = (sim[name].pose.position[0] for name in ("light", "heavy"))
    assert right - left == pytest.approx(0.4, abs=1e-3)
    assert -left == pytest.approx(4 * (right - 0.35), rel=0.05)
    assert max(speed(sim, "light"), speed(sim, "heavy")) < 0.02
    assert sim["far"].pose.position[0] == pytest.approx(3.02, abs=1e-6)
    assert sim["far"].pose.position[2] == pytest.approx(2 - GRAVITY * 0.02**2 / 2, abs=2e-4)


@pytest.mark.parametrize("balls", [((0.15, 0), (-0.15, 0)), ((-0.15, 0),)])
def test_a_robot_spawned_in_the_ground_stands_upright_on_it(load: Load, balls: tuple[tuple[float, float], ...]) -> None:
    vehicle = Vehicle(wheels=((0.05, 0.15), (0.05, -0.15)), balls=balls)
    sim = load(vehicle.sdf().replace('<link name="chassis">', '<pose>0 0 -0.06 0 0 0</pose><link name="chassis">', 1))
    sim.run(0.2)

    assert sim["vehicle"].pose.position == pytest.approx((0, 0, 0), abs=1e-3)
    assert sim["vehicle"].pose.rpy == pytest.approx((0, 0, 0), abs=1e-3)
    assert speed(sim, "vehicle") < 1e-2


SLAB = """<model name="floor"><static>true</static><pose>0 0 -1 0 0 0</pose><link name="l"><collision name="c">
<geometry><box><size>20 20 2</size></box></geometry></collision></link></model>"""


# Gazebo's positions follow its uncapped correction: what is hard is out in a step, what is soft within some 0.1 s.
@pytest.mark.parametrize("ground", [FLOOR, SLAB])
@pytest.mark.parametrize(
    ("contact", "depth", "speed"),
    [
        ("", 0.0, 0.01),
        ("<kp>1e6</kp><kd>100</kd><max_vel>1</max_vel>", 0.0, 0.05),
        ("<kp>2e5</kp><kd>25</kd>", ode_rest_depth(25.0 * 9.8 / 6, kp=2e5, kd=26.0), 0.2),
    ],
)
@pytest.mark.parametrize(
    "vehicle",
    [
        Vehicle(wheels=((0, 0.15), (0, -0.15)), balls=((0.15, 0), (-0.15, 0))),
        Vehicle(wheels=((0.25, 0.3), (-0.25, 0.3), (0.25, -0.3), (-0.25, -0.3)), mass=10.0, wheel_mass=2.0),
    ],
)
def test_a_robot_spawned_30_cm_in_the_ground_is_separated_at_once_and_settles(
    tmp_path: Path, ground: str, contact: str, depth: float, speed: float, vehicle: Vehicle
) -> None:
    surface = f"<contact><ode>{contact}</ode></contact></surface>"
    model = vehicle.sdf().replace('<link name="chassis">', '<pose>0 0 -0.3 0 0 0.3</pose><link name="chassis">', 1)
    file = tmp_path / "w.world"
    inside = f"<gravity>0 0 -9.8</gravity>{ground}{model.replace('</surface>', surface)}"
    file.write_text(f'<sdf version="1.6"><world name="w">{inside}</world></sdf>')
    sim = trundle.load(str(file))

    speeds: list[float] = []
    heights: list[float] = []
    for _ in range(1000):
        sim.step()
        speeds += [math.hypot(*link.twist.linear) for link in sim["vehicle"].links]
        heights.append(sim["vehicle"].pose.position[2])
    assert heights[0] == pytest.approx(0.0, abs=1e-3)
    assert max(heights) < 1e-3
    assert max(speeds) < speed
    assert sim["vehicle"].pose.position[:2] == pytest.approx((0.0, 0.0), abs=1e-3)
    assert sim["vehicle"].pose.rpy == pytest.approx((0.0, 0.0, 0.3), abs=1e-3)
    assert speeds[-1] < 1e-3
    if len(vehicle.wheels) == 2:  # of two points each, and two balls
        assert heights[-1] == pytest.approx(-depth, rel=0.1, abs=2e-4)
