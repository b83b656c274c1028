"""Drive laws in C++ within the step give the same bytes as laws in Python at every step."""

import math
import random
from pathlib import Path
from typing import Any

import pytest
from tests.gazebo.plugins.ros_control.laws_in_python import PythonDiffDrive, PythonJoint, PythonServo

import trundle
from trundle.gazebo.plugins.ros_control.hardware import JointHardware
from trundle.sim.control import DiffDriveLaw, Servo
from trundle.sim.simulation import Simulation

_WHEEL = """<link name="{0}"><pose>{1} {2} 0.08 0 0 0</pose><inertial><mass>0.3</mass><inertia><ixx>5e-4</ixx>
<iyy>8e-4</iyy><izz>5e-4</izz></inertia></inertial><collision name="c"><pose>0 0 0 1.5708 0 0</pose><geometry><cylinder>
<radius>0.08</radius><length>0.03</length></cylinder></geometry></collision></link><joint name="{0}_joint"
type="revolute"><parent>base</parent><child>{0}</child><axis><xyz>0 1 0</xyz></axis></joint>"""
_WHEEL_POSITIONS = {"fl": (0.1, 0.12), "fr": (0.1, -0.12), "rl": (-0.1, 0.12), "rr": (-0.1, -0.12)}
_GROUND = "<include><uri>model://ground_plane</uri></include>"
_INF = math.inf
_LIMITS = [
    ((-_INF, _INF, -_INF, _INF, -_INF, _INF), (-1.0, 1.0, -4.0, 2.0, -_INF, _INF)),
    ((-0.3, 0.8, -2.0, 1.0, -20.0, 20.0), (-_INF, _INF, -_INF, _INF, -50.0, 50.0)),
]


def _cart(folder: Path) -> Simulation:
    wheels = "".join(_WHEEL.format(name, x, y) for name, (x, y) in _WHEEL_POSITIONS.items())
    base = """<link name="base"><pose>0 0 0.12 0 0 0</pose><inertial><mass>5</mass><inertia><ixx>0.05</ixx>
<iyy>0.1</iyy><izz>0.1</izz></inertia></inertial></link>"""
    file = folder / "w.sdf"
    file.write_text(f'<sdf version="1.6"><world name="w">{_GROUND}<model name="m">{base}{wheels}</model></world></sdf>')
    return trundle.load(str(file))


class _InStep:
    def __init__(self, servo: Servo) -> None:
        self._servo = servo
        self.calls = 0

    def before_step(self, sim: Simulation) -> None:
        self.calls += 1
        dt = self._servo.read(sim.time_ns, sim.step_ns)
        if dt > 0.0:
            self._servo.update(dt)
            self._servo.write(dt)

    def step_action(self) -> tuple[Servo, float]:
        return self._servo, math.inf

    def finish_stride(self) -> None:
        pass


def _drive(sim: Simulation, seed: int, *, in_step: bool) -> Any:
    """Add a drive with random radii to a cart; return its law."""
    random_ = random.Random(seed)
    joint, cpp_law = (JointHardware, DiffDriveLaw) if in_step else (PythonJoint, PythonDiffDrive)
    wheels: dict[str, Any] = {
        name: joint(sim["m"].joint(f"{name}_joint"), "VelocityJointInterface", None, lag_s=0.005)
        for name in _WHEEL_POSITIONS
    }
    for wheel in wheels.values():
        wheel.read()
    drive: Any = cpp_law(
        [wheels["fl"], wheels["rl"]],
        [wheels["fr"], wheels["rr"]],
        wheel_radius=0.08,
        separation=0.24,
        radii=(0.08, 0.08 * random_.uniform(0.9, 1.1)),
        limits=_LIMITS[seed % 2],
        timeout_ns=40_000_000,
        open_loop=seed % 3 == 0,
        window=random_.choice((1, 10)),
    )
    drive.start()
    if in_step:
        servo = Servo(list(wheels.values()))
        servo.longest_ns = sim.step_ns
        servo.set_laws([drive])
        sim.add_hook(_InStep(servo))
    else:
        sim.add_hook(PythonServo(list(wheels.values()), [drive]))
    return drive


@pytest.mark.parametrize("seed", range(4))
def test_random_commands_give_the_same_bytes_as_in_python(tmp_path: Path, seed: int) -> None:
    random_ = random.Random(seed)
    cpp_sim, python_sim = _cart(tmp_path), _cart(tmp_path)
    cpp_law, python_law = _drive(cpp_sim, seed, in_step=True), _drive(python_sim, seed, in_step=False)
    for _ in range(12):
        twist = random_.gauss(0.0, 1.0), random_.gauss(0.0, 3.0)
        for drive in (cpp_law, python_law):
            drive.set_command(cpp_sim.time_ns, *twist)
        steps = random_.choice((1, 15, 90))
        cpp_sim.step(steps)
        python_sim.step(steps)
        assert (cpp_law.pose, cpp_law.limited, cpp_law.speeds) == (
            python_law.pose,
            python_law.limited,
            python_law.speeds,
        )
        assert cpp_sim["m"].pose == python_sim["m"].pose
    assert math.dist(cpp_law.pose, (0.0, 0.0, 0.0)) > 0.001
    (hook,) = cpp_sim.hooks
    assert isinstance(hook, _InStep)
    assert hook.calls <= 12
