"""Springs and chains of links keep their energy, and follow the truth to second order in the step."""

import copy
import math
from pathlib import Path

import mujoco
import numpy as np
import pytest
from msgspec.structs import replace

import trundle
from trundle.sim.physics import Engine
from trundle.sim.physics.compile.law_tables import disable_laws
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose

G = 9.8
SPRING = """<dynamics><damping>{}</damping><spring_reference>0</spring_reference>
<spring_stiffness>{}</spring_stiffness></dynamics>"""


def _link(name: str, pose: str, mass: float, moments: tuple[float, float, float], com: str = "0 0 0") -> str:
    ixx, iyy, izz = moments
    return f"""<link name="{name}"><pose>{pose} 0 0 0</pose><inertial><pose>{com} 0 0 0</pose><mass>{mass}</mass>
    <inertia><ixx>{ixx}</ixx><iyy>{iyy}</iyy><izz>{izz}</izz></inertia></inertial></link>"""


def _joint(name: str, kind: str, parent: str, child: str, inside: str = "<xyz>0 1 0</xyz>", pose: str = "0 0 0") -> str:
    axis = "" if kind == "ball" else f"<axis>{inside}</axis>"
    pose = f"<pose>{pose} 0 0 0</pose>"
    return f'<joint name="{name}" type="{kind}">{pose}<parent>{parent}</parent><child>{child}</child>{axis}</joint>'


def _load(folder: Path, model: str, *, step_s: float = 0.001, more: str = "") -> Simulation:
    file = folder / "w.sdf"
    physics = f'<gravity>0 0 {-G}</gravity><physics type="ode"><max_step_size>{step_s}</max_step_size></physics>'
    world = f'<world name="w">{physics}<model name="m">{model}</model>{more}</world>'
    file.write_text(f'<sdf version="1.7">{world}</sdf>')
    return trundle.load(str(file))


def _spring(folder: Path, *, inertia: float, stiffness: float, damping: float = 0.0) -> Simulation:
    link = _link("a", "0 0 1", 1.0, (inertia, inertia, inertia))
    spring = f"<xyz>0 0 1</xyz>{SPRING.format(damping, stiffness)}"
    return _load(folder, link + _joint("j", "revolute", "world", "a", spring))


def _energy(engine: Engine) -> float:
    data = mujoco.MjData(engine.compiled.model)
    data.qpos[:], data.qvel[:] = engine.reader.state()
    mujoco.mj_forward(engine.compiled.model, data)
    mujoco.mj_energyPos(engine.compiled.model, data)
    mujoco.mj_energyVel(engine.compiled.model, data)
    return float(data.energy.sum())


def _state(engine: Engine) -> np.ndarray:
    model, data = engine.compiled.model, engine.save().data
    state = np.empty(mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_PHYSICS))
    mujoco.mj_getState(model, data, state, mujoco.mjtState.mjSTATE_PHYSICS)
    return state


def _truth(engine: Engine, *, steps: int) -> mujoco.MjData:
    """State after so many steps by the Runge-Kutta method, with a tenth of the step."""
    model = copy.copy(engine.compiled.model)
    disable_laws(model)
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_ACTUATION
    model.opt.timestep /= 10
    data = mujoco.MjData(model)
    mujoco.mj_setState(model, data, _state(engine), mujoco.mjtState.mjSTATE_PHYSICS)
    mujoco.mj_step(model, data, nstep=10 * steps)
    mujoco.mj_kinematics(model, data)
    return data


@pytest.mark.parametrize("stiffness", [0.5, 50.0, 500.0])
def test_an_undamped_spring_keeps_swinging(tmp_path: Path, stiffness: float) -> None:
    """ω h from 0.003 to 0.1, ten seconds; in phase as well."""
    sim = _spring(tmp_path, inertia=0.05, stiffness=stiffness)
    joint, rate = sim["m"].joint("j"), math.sqrt(stiffness / 0.05)
    joint.set_position(0.3)
    sim.run(10.0 - 2 * math.pi / rate)
    positions: list[float] = []
    while sim.time_ns < 10_000_000_000:
        sim.step()
        positions.append(joint.position)

    assert max(positions) == pytest.approx(0.3, rel=0.01)
    assert min(positions) == pytest.approx(-0.3, rel=0.01)


def test_a_spring_stiffer_than_a_step_can_follow_is_stable(tmp_path: Path) -> None:
    sim = _spring(tmp_path, inertia=1e-4, stiffness=1e4)
    sim["m"].joint("j").set_position(0.3)
    sim.run(1.0)

    assert abs(sim["m"].joint("j").position) < 1e-3


def test_a_damped_spring_settles_at_the_rate_of_its_damper(tmp_path: Path) -> None:
    """A suspension: k 2e4, c 100, 10 kg·m²: e^(−5 t) cos(44.4 t), after half a second."""
    sim = _spring(tmp_path, inertia=10.0, stiffness=2e4, damping=100.0)
    sim["m"].joint("j").set_position(0.01)
    sim.run(0.5)

    rate = math.sqrt(2e4 / 10 - 25)
    truth = 0.01 * math.exp(-2.5) * (math.cos(rate * 0.5) + 5 / rate * math.sin(rate * 0.5))
    assert sim["m"].joint("j").position == pytest.approx(truth, rel=0.03)


def test_a_double_pendulum_keeps_its_energy_for_a_minute(tmp_path: Path) -> None:
    upper = _link("a", "0 0 2", 1.0, (0.01, 0.01, 0.01), "0 0 -0.25")
    lower = _link("b", "0 0 1.5", 1.0, (0.01, 0.01, 0.01), "0 0 -0.25")
    sim = _load(tmp_path, upper + lower + _joint("j1", "revolute", "world", "a") + _joint("j2", "revolute", "a", "b"))
    sim["m"].joint("j1").set_position(1.5)
    before = _energy(sim.engine)
    sim.run(60.0)

    swing = 2 * G * 0.5  # of both from where they hang to level
    assert _energy(sim.engine) == pytest.approx(before, abs=0.01 * swing)


def test_a_double_pendulum_on_a_box_that_stands_keeps_its_energy(tmp_path: Path) -> None:
    """The box weighs 50 kg, and stays; without a middle it lost 1.7 J in 20 s."""
    collision = '<collision name="c"><geometry>{}</geometry></collision></link>'
    box = collision.format("<box><size>0.6 0.6 0.2</size></box>")
    base = _link("base", "0 0 0.1", 50.0, (1.7, 1.7, 3.0)).replace("</link>", box)
    upper = _link("a", "0 0.4 0.85", 1.0, (0.021, 0.021, 0.0004))
    lower = _link("b", "0 0.4 0.35", 1.0, (0.021, 0.021, 0.0004))
    joints = _joint("j1", "revolute", "base", "a", pose="0 0 0.25") + _joint(
        "j2", "revolute", "a", "b", pose="0 0 0.25"
    )
    plane = collision.format("<plane><normal>0 0 1</normal></plane>")
    floor = f'<model name="floor"><static>true</static><link name="l">{plane}</model>'
    sim = _load(tmp_path, base + upper + lower + joints, more=floor)
    sim["m"].joint("j1").set_position(1.5)
    before = _energy(sim.engine)
    sim.run(20.0)

    assert sim["m"].link("base").pose.position == pytest.approx((0.0, 0.0, 0.1), abs=1e-4)
    assert _energy(sim.engine) == pytest.approx(before, abs=0.05)


def _angle_between(a: np.ndarray, b: np.ndarray) -> float:
    """Angle between two orientations [rad]."""
    return 2 * math.acos(min(abs(float(np.dot(a, b))), 1.0))


@pytest.mark.parametrize("com", ["0.3 0 0", "0.1 -0.2 -0.3", "-0.05 0.38 -0.1", "0 0 -0.4"])
@pytest.mark.parametrize("speeds", [(2.0, 3.0, 5.0), (-4.0, 1.0, -3.0), (0.0, 0.0, 0.0)])
def test_a_pendulum_on_a_ball_joint_follows_the_exact_motion(
    tmp_path: Path, com: str, speeds: tuple[float, float, float]
) -> None:
    """For 3 s; 90 mrad off in the worst of 24 if velocities count as those of the start of a step (Gazebo: 2.8 in its
    case).
    """
    sim = _load(tmp_path, _link("a", "0 0 2", 1.0, (0.02, 0.03, 0.015), com) + _joint("j", "ball", "world", "a"))
    joint = sim["m"].joint("j")
    for axis, speed in enumerate(speeds):
        joint.set_velocity(speed, axis=axis)
    truth, before = _truth(sim.engine, steps=3000), _energy(sim.engine)
    sim.step(3000)

    assert _energy(sim.engine) == pytest.approx(before, abs=2e-3)
    assert _angle_between(_state(sim.engine)[:4], truth.qpos) < 1e-3


def test_a_pendulum_on_a_ball_joint_swings_on_when_a_model_is_spawned(tmp_path: Path) -> None:
    pendulum = _link("a", "0 0 2", 1.0, (0.02, 0.03, 0.015), "0.3 0 0") + _joint("j", "ball", "world", "a")
    alone, spawned = (_load(tmp_path, pendulum) for _ in range(2))
    for sim in (alone, spawned):
        sim["m"].joint("j").set_velocity(3.0, axis=1)
        sim.step(1000)
    spawned.spawn(replace(spawned.world.models[0], name="far", world_from_model=Pose((50.0, 0.0, 0.0))))
    for sim in (alone, spawned):
        sim.step(1000)

    assert spawned["m"].link("a").pose.as_list() == pytest.approx(alone["m"].link("a").pose.as_list(), abs=1e-12)


def test_a_chain_of_six_links_follows_the_exact_motion(tmp_path: Path) -> None:
    model, parent = "", "world"
    for i in range(6):
        model += _link(f"l{i}", f"{0.2 * i} 0 2", 0.5, (0.001, 0.002, 0.002), "0.1 0 0")
        model += _joint(f"j{i}", "revolute", parent, f"l{i}")
        parent = f"l{i}"
    sim = _load(tmp_path, model)
    sim["m"].joint("j0").set_position(1.0)
    truth = _truth(sim.engine, steps=3000)
    sim.step(3000)

    last = truth.body("m::l5").xpos
    assert sim["m"].link("l5").pose.position == pytest.approx(tuple(last), abs=1e-3)


def _four_bars() -> str:
    """A loop that a constraint closes."""
    return (
        _link("crank", "0 0 1", 1.0, (0.002, 0.002, 0.002), "0 0 0.075")
        + _link("coupler", "0 0 1.15", 1.0, (0.01, 0.01, 0.01), "0.25 0 0.1")
        + _link("rocker", "0.5 0 1", 1.0, (0.01, 0.01, 0.01), "0 0 0.175")
        + _joint("j1", "revolute", "world", "crank")
        + _joint("j2", "revolute", "crank", "coupler")
        + _joint("j3", "revolute", "world", "rocker")
        + _joint("j4", "revolute", "rocker", "coupler", pose="0.5 0 0.2")
    )


def test_a_four_bar_crank_keeps_its_energy(tmp_path: Path) -> None:
    """The crank goes round at 6 rad/s and on by itself."""
    sim = _load(tmp_path, _four_bars())
    crank = sim["m"].joint("j1")
    crank.command_velocity(6.0)
    sim.run(1.5)
    crank.command_effort(0.0)
    before = _energy(sim.engine)
    sim.run(10.0)

    assert _energy(sim.engine) == pytest.approx(before, rel=0.01)


@pytest.mark.parametrize("speed", [3.0, 6.0, 10.0])
def test_a_four_bar_crank_agrees_with_smaller_steps(tmp_path: Path, speed: float) -> None:
    """For 3 s and 4 to 7 turns (ODE's algorithm is 0.4 to 0.7 rad behind by then)."""
    courses: list[list[float]] = []
    for step_s in (0.001, 0.0001):
        sim = _load(tmp_path, _four_bars(), step_s=step_s)
        # The coupler begins level, and so does not turn; the rocker is 0.35 m to the crank's 0.15 m.
        for name, rate in (("j1", 1.0), ("j2", -1.0), ("j3", 3 / 7), ("j4", -3 / 7)):
            sim["m"].joint(name).set_velocity(rate * speed)
        courses.append([])
        for _ in range(30):
            sim.run(0.1)
            courses[-1].append(sim["m"].joint("j1").position)

    assert courses[0] == pytest.approx(courses[1], abs=0.035)
