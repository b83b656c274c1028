"""Pendulums on joints of every type come nearer to the truth by the square of the step, in position and velocity.

The truth is MuJoCo's plain equations of motion of the same numbers, integrated by DOP853 to 1e-12.
"""

import math
from pathlib import Path

import mujoco
import numpy as np
import pytest
from msgspec import Struct
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

import trundle
from trundle.sim.simulation import Simulation

G = 9.8
SECONDS = 2.0
STEPS_S = (0.002, 0.001, 0.0005)
MOMENTS = (0.02, 0.03, 0.015)
_Array = NDArray[np.float64]


class Arm(Struct, frozen=True):
    """A link of 1 kg below the last one, and the joint that it hangs on."""

    kind: str
    com: tuple[float, float, float]
    speeds: tuple[float, ...]
    axes: tuple[tuple[float, float, float], ...] = ((0.0, 1.0, 0.0),)
    damping: float = 0.0
    stiffness: float = 0.0
    below: float = 0.0
    """[m] from the joint of the last link."""


def _text(values: tuple[float, ...]) -> str:
    return " ".join(map(str, values))


def _sdf(arms: tuple[Arm, ...], step_s: float) -> str:
    model, parent, height = "", "world", 2.0
    for i, arm in enumerate(arms):
        height -= arm.below
        ixx, iyy, izz = MOMENTS
        model += f"""<link name="l{i}"><pose>0 0 {height} 0 0 0</pose><inertial><pose>{_text(arm.com)} 0 0 0</pose>
        <mass>1</mass><inertia><ixx>{ixx}</ixx><iyy>{iyy}</iyy><izz>{izz}</izz></inertia></inertial></link>"""
        dynamics = f"<damping>{arm.damping}</damping><spring_stiffness>{arm.stiffness}</spring_stiffness>"
        axes = "".join(
            f"<{tag}><xyz>{_text(axis)}</xyz><dynamics>{dynamics}</dynamics></{tag}>"
            for tag, axis in zip(("axis", "axis2"), arm.axes, strict=False)
        )
        inside = f"<parent>{parent}</parent><child>l{i}</child>{'' if arm.kind == 'ball' else axes}"
        model += f'<joint name="j{i}" type="{arm.kind}">{inside}</joint>'
        parent = f"l{i}"
    physics = f'<gravity>0 0 {-G}</gravity><physics type="ode"><max_step_size>{step_s}</max_step_size></physics>'
    return f'<sdf version="1.7"><world name="w">{physics}<model name="m">{model}</model></world></sdf>'


def _mjcf(arms: tuple[Arm, ...]) -> str:
    bodies, below = "", 2.0
    for i, arm in enumerate(arms):
        kind = {"ball": "ball", "prismatic": "slide"}.get(arm.kind, "hinge")
        joints = "".join(
            f'<joint type="{kind}" axis="{_text(axis)}" damping="{arm.damping}" stiffness="{arm.stiffness}"/>'
            for axis in arm.axes
        )
        inertial = f'<inertial pos="{_text(arm.com)}" mass="1" diaginertia="{_text(MOMENTS)}"/>'
        bodies += f'<body name="l{i}" pos="0 0 {-arm.below if i else below}">{joints}{inertial}'
    bodies += "</body>" * len(arms)
    return f'<mujoco><option gravity="0 0 {-G}"/><worldbody>{bodies}</worldbody></mujoco>'


def _truth(arms: tuple[Arm, ...]) -> tuple[_Array, _Array]:
    """Return quaternion and position, and velocity and angular velocity in the world, of the last link."""
    model = mujoco.MjModel.from_xml_string(_mjcf(arms))
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_EULERDAMP
    data = mujoco.MjData(model)

    def change(_t: float, state: _Array) -> _Array:
        data.qpos[:], data.qvel[:] = state[: model.nq], state[model.nq :]
        mujoco.mj_normalizeQuat(model, data.qpos)
        mujoco.mj_forward(model, data)
        rates = np.zeros(model.nq)
        for joint in range(model.njnt):
            q, v = int(model.jnt_qposadr[joint]), int(model.jnt_dofadr[joint])
            if model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_BALL:
                mujoco.mju_mulQuat(rates[q : q + 4], data.qpos[q : q + 4], np.array([0.0, *data.qvel[v : v + 3]]) / 2)
            else:
                rates[q] = data.qvel[v]
        return np.concatenate([rates, data.qacc])

    speeds = np.concatenate([arm.speeds for arm in arms])
    start = np.concatenate([model.qpos0, speeds])
    end = solve_ivp(change, (0.0, SECONDS), start, method="DOP853", rtol=1e-12, atol=1e-12).y[:, -1]
    change(0.0, end)
    last = model.body(f"l{len(arms) - 1}").id
    twist = np.zeros(6)
    mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_XBODY, last, twist, 0)
    return np.concatenate([data.xquat[last], data.xpos[last]]), np.concatenate([twist[3:], twist[:3]])


def _run(arms: tuple[Arm, ...], folder: Path, step_s: float) -> Simulation:
    file = folder / "w.sdf"
    file.write_text(_sdf(arms, step_s))
    sim = trundle.load(str(file))
    for i, arm in enumerate(arms):
        for axis, speed in enumerate(arm.speeds):
            sim["m"].joint(f"j{i}").set_velocity(speed, axis=axis)
    return sim


def _errors(arms: tuple[Arm, ...], folder: Path, step_s: float, truth: tuple[_Array, _Array]) -> tuple[float, float]:
    """Return the error of the last link's pose [m and rad], and of its twist [m/s and rad/s]."""
    sim = _run(arms, folder, step_s)
    sim.step(round(SECONDS / step_s))
    link = sim["m"].link(f"l{len(arms) - 1}")
    pose = np.array([*link.pose.quaternion, *link.pose.position])
    turned = 2 * np.linalg.norm(pose[:4] - math.copysign(1.0, pose[:4] @ truth[0][:4]) * truth[0][:4])
    twist = np.array([*link.twist.linear, *link.twist.angular])
    return float(np.hypot(turned, np.linalg.norm(pose[4:] - truth[0][4:]))), float(np.linalg.norm(twist - truth[1]))


SIDE, DOWN = (0.3, 0.0, 0.0), (0.05, 0.1, -0.3)
CASES: dict[str, tuple[Arm, ...]] = {
    "revolute": (Arm("revolute", SIDE, (3.0,)),),
    "revolute at rest": (Arm("revolute", SIDE, (0.0,)),),
    "damped": (Arm("revolute", SIDE, (3.0,), damping=0.2),),
    "sprung and damped": (Arm("continuous", SIDE, (3.0,), damping=0.1, stiffness=5.0),),
    "prismatic": (Arm("prismatic", SIDE, (1.0,), axes=((0.0, 0.6, 0.8),), damping=0.5, stiffness=200.0),),
    "universal": (Arm("universal", DOWN, (2.0, -3.0), axes=((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))),),
    "revolute2": (Arm("revolute2", DOWN, (1.0, 2.0), axes=((0.0, 0.0, 1.0), (0.0, 1.0, 0.0)), damping=0.05),),
    "ball": (Arm("ball", DOWN, (2.0, 3.0, -1.0)),),
    "ball at rest": (Arm("ball", SIDE, (0.0, 0.0, 0.0)),),
    "two balls": (Arm("ball", DOWN, (1.0, 2.0, 0.0)), Arm("ball", DOWN, (0.0, -1.0, 1.0), below=0.4)),
    "ball on a hinge": (Arm("revolute", DOWN, (2.0,), damping=0.1), Arm("ball", DOWN, (1.0, 0.0, 1.0), below=0.4)),
    "two hinges": (Arm("revolute", DOWN, (2.0,)), Arm("revolute", DOWN, (-1.0,), stiffness=3.0, below=0.4)),
}


@pytest.mark.parametrize("arms", CASES.values(), ids=CASES.keys())
def test_half_the_step_gives_a_quarter_of_the_error(arms: tuple[Arm, ...], tmp_path: Path) -> None:
    truth = _truth(arms)
    errors = np.array([_errors(arms, tmp_path, step_s, truth) for step_s in STEPS_S])

    assert errors[1, 0] < 1e-4
    assert errors[1, 1] < 5e-4
    assert errors[0] / errors[1] == pytest.approx((4.0, 4.0), rel=0.15)
    assert errors[1] / errors[2] == pytest.approx((4.0, 4.0), rel=0.15)


def test_a_screw_pendulum_accelerates_by_its_weight(tmp_path: Path) -> None:
    """x = −θ / pitch, and θ'' = m g / pitch / (I + m / pitch²), of an upright screw that falls and turns."""
    pitch, start, speed, seconds = 5.0, 0.5, 2.0, 1.0
    text = _sdf((Arm("screw", (0.0, 0.0, 0.0), (speed,), axes=((0.0, 0.0, 1.0),)),), 0.001)
    (tmp_path / "w.sdf").write_text(text.replace("<parent>", f"<thread_pitch>{pitch}</thread_pitch><parent>"))
    sim = trundle.load(str(tmp_path / "w.sdf"))
    joint, link = sim["m"].joint("j0"), sim["m"].link("l0")
    joint.set_position(start)
    joint.set_velocity(speed)
    assert link.pose.position[2] == pytest.approx(2.0 - start / pitch)
    assert link.twist.linear[2] == pytest.approx(-speed / pitch)
    sim.run(seconds)

    acceleration = G / pitch / (MOMENTS[2] + 1 / pitch**2)
    turned = start + speed * seconds + acceleration / 2 * seconds**2
    assert joint.position == pytest.approx(turned, abs=1e-3)
    assert joint.velocity == pytest.approx(speed + acceleration * seconds, abs=1e-3)
    assert link.pose.position[2] == pytest.approx(2.0 - turned / pitch, abs=1e-4)


@pytest.mark.parametrize("name", ["revolute", "ball", "two balls", "two hinges"])
def test_a_pendulum_neither_loses_nor_gains_energy(name: str, tmp_path: Path) -> None:
    """Largest difference within half a minute, of 3 to 5 J to swing by."""
    sim = _run(CASES[name], tmp_path, 0.001)
    model = sim.engine.compiled.model
    springs = [arm.stiffness for arm in CASES[name]]

    def energy() -> float:
        data = mujoco.MjData(model)
        data.qpos[:], data.qvel[:] = sim.engine.reader.state()
        mujoco.mj_forward(model, data)
        mujoco.mj_energyPos(model, data)
        mujoco.mj_energyVel(model, data)
        stored = sum(k * q * q / 2 for k, q in zip(springs, data.qpos, strict=False) if k)
        return float(data.energy.sum()) + stored

    before = energy()
    largest = 0.0
    for _ in range(300):
        sim.run(0.1)
        largest = max(largest, abs(energy() - before))

    assert largest < 1e-3


def test_velocities_are_continuous_when_an_effort_begins(tmp_path: Path) -> None:
    """A tree that is driven has the positions half a step ahead, and not the velocities half a step behind."""
    sim = _run(CASES["revolute"], tmp_path, 0.001)
    joint = sim["m"].joint("j0")
    sim.step(200)
    speeds = [joint.velocity]
    for _ in range(3):
        joint.command_effort(1e-6)
        sim.step()
        speeds.append(joint.velocity)

    changes = np.diff(speeds)
    assert changes == pytest.approx([changes[1]] * 3, rel=0.02)


def test_rows_of_a_batch_read_the_velocities_of_the_engine(tmp_path: Path) -> None:
    sim = _run(CASES["ball on a hinge"], tmp_path, 0.001)
    batch = sim.engine.batch(1, threads=1)
    batch.write_row(0, sim.engine.world_row())
    for _ in range(3):
        sim.step()
        batch.step(1)
        axis = sim.engine.compiled.first_axes[0]
        assert batch.velocities([axis])[0].tolist() == [sim["m"].joint("j0").velocity]
        assert batch.twists[0].tolist() == sim.engine.reader.link_twists().tolist()
