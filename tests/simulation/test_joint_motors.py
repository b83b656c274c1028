"""Motors told anew at every step, by loops that others close around them."""

import pytest

from trundle.description import load
from trundle.diagnostics import Diagnostics
from trundle.packages import Packages
from trundle.simulation import Simulation

_LIGHT = """<sdf version="1.6"><world name="w"><model name="m"><link name="base"/>
<link name="wheel"><inertial><mass>0.1</mass>
<inertia><ixx>0.001</ixx><iyy>0.001</iyy><izz>0.001</izz></inertia></inertial>
</link><joint name="fix" type="fixed"><parent>world</parent><child>base</child></joint>
<joint name="axle" type="revolute"><parent>base</parent><child>wheel</child><axis><xyz>0 0 1</xyz>
<limit><effort>10</effort></limit></axis></joint></model></world></sdf>"""


@pytest.mark.parametrize("speed", [0.5, 5.0, 50.0])
def test_a_strong_motor_of_a_light_wheel_does_not_chatter(tmp_path, speed: float) -> None:
    """10 N·m on 0.001 kg·m² change the speed by 10 rad/s in a step, past what is wanted and back."""
    path = tmp_path / "light.world"
    path.write_text(_LIGHT)
    report = Diagnostics()
    simulation = Simulation(load(str(path), report, packages=Packages({}, start=tmp_path)).world, report)
    axle = simulation["m"].joint("axle")
    for _ in range(50):
        axle.set_velocity(speed)
        simulation.step()
    speeds: list[float] = []
    for _ in range(5):
        axle.set_velocity(speed)
        simulation.step()
        speeds.append(axle.velocity)
    assert speeds == pytest.approx([speed] * 5, rel=1e-3)
