"""Commands of motors, combined with commands of hardware interfaces."""

import math
import random
from pathlib import Path

import pytest
from tests.sim.physics.step.motors_in_python import PythonMotors

import trundle
from trundle.sim.physics import Engine
from trundle.sim.physics.step.motors import Motors

_LINK = """<link name="{0}"><inertial><mass>1</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia>
</inertial></link>"""
_LIMITS = (
    "",
    "<effort>2</effort><velocity>1</velocity>",
    "<effort>0</effort>",
    "<effort>3</effort>",
    "<velocity>0.5</velocity>",
)


def _chain(folder: Path) -> Engine:
    joints = "".join(
        f"""{_LINK.format(f"l{i}")}<joint name="j{i}" type="revolute"><parent>{f"l{i - 1}" if i else "world"}</parent>
        <child>l{i}</child><axis><xyz>{i % 2} {1 - i % 2} 0</xyz><limit>{limit}</limit></axis></joint>"""
        for i, limit in enumerate(_LIMITS)
    )
    file = folder / "w.sdf"
    file.write_text(f'<sdf version="1.7"><world name="w"><model name="m">{joints}</model></world></sdf>')
    return trundle.load(str(file)).engine


def _rules(engine: Engine) -> PythonMotors:
    return PythonMotors(engine.compiled, engine._data)


def _command(motors: Motors | PythonMotors, random_: random.Random) -> None:
    """Send a random command to a random axis."""
    axis, hardware = random_.randrange(len(_LIMITS)), random_.random() < 0.5
    value = random_.choice((0.0, -0.3, 0.4, 0.40001, 1.7, -5.0, random_.gauss(0.0, 2.0)))
    effort = random_.choice((0.0, 0.7, 4.0, math.inf))
    match random_.randrange(5):
        case 0 | 1:
            motors.command_effort(axis, value, hardware=hardware)
        case 2:
            motors.command_velocity(axis, value, effort, hardware=hardware)
        case 3:
            motors.command_position(axis, value, effort)
        case _:
            motors.drive_kinematically(axis, value, hardware=hardware)


@pytest.mark.parametrize("seed", range(6))
def test_random_commands_write_the_same_bytes_as_the_python_model(tmp_path: Path, seed: int) -> None:
    """Also when the numbers of a command move the world between them, and one is repeated."""
    engine, other = _chain(tmp_path), _chain(tmp_path)
    rules, written = _rules(other), _rules(engine)  # the latter only reads
    for count in range(400):
        _command(engine.motors, random.Random(f"{seed} {count}"))
        _command(rules, random.Random(f"{seed} {count}"))
        axis = count % len(_LIMITS)
        assert engine.motors.command_of(axis) == rules.command_of(axis)
        if count % 7 == 0:
            command = rules.command_of(axis)
            engine.motors.repeat(axis, command)
            rules.repeat(axis, command)
        assert written.numbers() == rules.numbers()
        if count % 3 == 0:
            engine.step(2)
            other.step(2)


def test_saved_commands_are_restored(tmp_path: Path) -> None:
    engine = _chain(tmp_path)
    engine.motors.command_velocity(3, 0.5, 2.0)
    engine.motors.command_effort(3, 0.25, hardware=True)
    saved, written = engine.save(), _rules(engine)
    before = written.numbers()
    engine.motors.command_position(3, 1.0, 1.0)
    engine.motors.drive_kinematically(1, 0.5, hardware=True)
    assert written.numbers() != before
    engine.restore(saved)

    assert written.numbers() == before
    engine.motors.command_effort(3, 0.5, hardware=True)  # still combined with the direct speed
    assert (written.data.ctrl[3], written.data.qfrc_applied[3]) == (0.5, 0.5)
