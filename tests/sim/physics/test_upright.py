"""Cylinders that stand on a floor: MuJoCo's own search puts their contacts where rounding points to."""

import math
from collections.abc import Callable
from pathlib import Path

import pytest
from tests.sim.physics.quasistatic import GRAVITY

import trundle
from trundle.sim.simulation import Simulation
from trundle.spatial import Twist

Load = Callable[..., Simulation]


@pytest.fixture
def load(tmp_path: Path) -> Load:
    """Load an upright cylinder on a floor."""

    def load(radius: float, length: float, mass: float, *, roll: float) -> Simulation:
        turning = mass * radius**2 / 2
        moments = "".join(f"<{m}>{turning}</{m}>" for m in ("ixx", "iyy", "izz"))
        shape = f"<geometry><cylinder><radius>{radius}</radius><length>{length}</length></cylinder></geometry>"
        inertial = f"<inertial><mass>{mass}</mass><inertia>{moments}</inertia></inertial>"
        pose = f"<pose>0.3 0.2 {length / 2} {roll} 0 0.1</pose>"
        file = tmp_path / "w.world"
        file.write_text(
            f"""<sdf version="1.6"><world name="w"><gravity>0 0 {-GRAVITY}</gravity><model name="floor">
            <static>true</static><link name="l"><collision name="c"><geometry><plane/></geometry></collision></link>
            </model><model name="b">{pose}<link name="l">{inertial}<collision name="c">{shape}</collision></link>
            </model></world></sdf>"""
        )
        return trundle.load(str(file))

    return load


# Before, the first fell through the floor by 3 mm, jumped up by 10 cm and went its way.
@pytest.mark.parametrize("roll", [0.0, math.pi])
@pytest.mark.parametrize(
    ("radius", "length", "mass", "speed"), [(0.1, 0.2, 1.0, 10.0), (0.03, 0.2, 0.1, -20.0), (0.5, 0.1, 50.0, 4.0)]
)
def test_a_spinning_cylinder_stops_where_it_stands(
    load: Load, radius: float, length: float, mass: float, speed: float, roll: float
) -> None:
    sim = load(radius, length, mass, roll=roll)
    sim.run(0.2)
    x, y, z = sim["b"].pose.position
    sim["b"].links[0].set_twist(Twist(angular=(0.0, 0.0, speed)))
    slowing = 2 * GRAVITY / radius  # friction at the rim over m r² / 2
    turned, before = 0.0, sim["b"].pose.rpy[2]
    for _ in range(1000):
        sim.step()
        now = sim["b"].pose.rpy[2]
        turned, before = turned + math.remainder(now - before, math.tau), now
        assert sim["b"].pose.position == pytest.approx((x, y, z), abs=5e-5)
    assert turned == pytest.approx(math.copysign(speed**2 / (2 * slowing), speed), rel=0.03)
    assert sim["b"].links[0].twist.angular[2] == pytest.approx(0.0, abs=1e-6)
