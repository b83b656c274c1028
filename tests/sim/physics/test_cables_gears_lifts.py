"""Cables of many links, gearboxes and lifts of random numbers, against their equations of motion (by DOP853)."""

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

import trundle
from trundle.sim.simulation import Simulation

G = 9.8
_Array = NDArray[np.float64]
_HINGES = {
    "revolute": "<axis><xyz>0 1 0</xyz>{0}</axis>",
    "universal": "<axis><xyz>1 0 0</xyz>{0}</axis><axis2><xyz>0 1 0</xyz>{0}</axis2>",
    "ball": "",
}


def _load(folder: Path, model: str, *, ground: str = "") -> Simulation:
    (folder / "w.sdf").write_text(
        f'<sdf version="1.7"><world name="w"><gravity>0 0 {-G}</gravity><physics type="ode"/>{ground}'
        f'<model name="m">{model}</model></world></sdf>'
    )
    return trundle.load(str(folder / "w.sdf"))


def _link(name: str, pose: str, mass: float, moment: float, *, com: str = "0 0 0", more: str = "") -> str:
    moments = "".join(f"<i{axis}>{moment}</i{axis}>" for axis in ("xx", "yy", "zz"))
    inertial = f"<inertial><pose>{com} 0 0 0</pose><mass>{mass}</mass><inertia>{moments}</inertia></inertial>"
    return f'<link name="{name}"><pose>{pose}</pose>{inertial}{more}</link>'


def _integrated(motion: Callable[[float, _Array], _Array], state: _Array, seconds: float) -> _Array:
    return solve_ivp(motion, (0.0, seconds), state, method="DOP853", rtol=1e-8, atol=1e-9).y[:, -1]


class _Cable:
    """Rods on joints, hanging from the world at the origin; angles [rad] are from the vertical."""

    def __init__(self, rng: np.random.Generator, count: int, load: float, damped: bool) -> None:
        self.lengths = rng.uniform(0.02, 0.2, count)
        self.masses = rng.uniform(0.02, 0.5, count)
        self.masses[-1] *= load
        self.moments = self.masses * self.lengths**2 / 12 * rng.uniform(0.8, 3.0, count)
        self.dampings = rng.uniform(0.0, 0.02, count) if damped else np.zeros(count)
        self.angles = rng.uniform(0.2, 1.0) + rng.uniform(-0.1, 0.1, count)

    def sdf(self, kind: str) -> str:
        text, parent, x, z = "", "world", 0.0, 0.0
        for i, (length, angle) in enumerate(zip(self.lengths, self.angles, strict=True)):
            pose, com = f"{x} 0 {z} 0 {-angle} 0", f"0 0 {-length / 2}"
            text += _link(f"l{i}", pose, self.masses[i], self.moments[i], com=com)
            axes = _HINGES[kind].format(f"<dynamics><damping>{self.dampings[i]}</damping></dynamics>")
            text += f'<joint name="j{i}" type="{kind}"><parent>{parent}</parent><child>l{i}</child>{axes}</joint>'
            parent, x, z = f"l{i}", x + length * math.sin(angle), z - length * math.cos(angle)
        return text

    def end(self, seconds: float) -> tuple[float, float, float]:
        """Position of the end: M_ij cos(θ_i − θ_j) θ''_j = −M_ij sin(θ_i − θ_j) θ'_j² − g w_i sin θ_i − D θ'."""
        count = len(self.lengths)
        reach = np.tril(np.tile(self.lengths, (count, 1)), -1) + np.diag(self.lengths / 2)
        coupling, weights = reach.T @ np.diag(self.masses) @ reach, reach.T @ self.masses
        differences = np.eye(count) - np.eye(count, k=-1)
        damping = differences.T @ np.diag(self.dampings) @ differences

        def motion(_time: float, state: _Array) -> _Array:
            angle, rate = state[:count], state[count:]
            between = angle[:, None] - angle[None, :]
            torque = -(coupling * np.sin(between)) @ rate**2 - G * weights * np.sin(angle) - damping @ rate
            inertia = coupling * np.cos(between) + np.diag(self.moments)
            return np.concatenate([rate, np.linalg.solve(inertia, torque)], dtype=np.float64)

        angles = _integrated(motion, np.concatenate([self.angles, np.zeros(count)]), seconds)[:count]
        return float(self.lengths @ np.sin(angles)), 0.0, float(-self.lengths @ np.cos(angles))


@pytest.mark.parametrize("kind", _HINGES)
@pytest.mark.parametrize(("count", "load"), [(20, 1.0), (10, 20.0)])
def test_a_cable_swings_as_a_chain_of_rods(tmp_path: Path, kind: str, count: int, load: float) -> None:
    """Rods of 2 to 20 cm, up to 3 m in all, with a load of up to 10 kg; no rod turns the others on a ball joint."""
    cable = _Cable(np.random.default_rng(count), count, load, damped=kind != "ball")
    sim = _load(tmp_path, cable.sdf(kind))
    sim.run(1.5)
    end = sim["m"].link(f"l{count - 1}").pose.transform_point((0.0, 0.0, -float(cable.lengths[-1])))
    assert math.dist(end, cable.end(1.5)) < (2e-3 if kind == "ball" else 5e-4)


@pytest.mark.parametrize("seed", range(4))
def test_a_gearbox_turns_a_load_by_its_ratio(tmp_path: Path, seed: int) -> None:
    """Ratio, sign, moments, damping, efforts and an eccentric load are random; every second one is a bevel gear."""
    rng = np.random.default_rng(seed)
    ratio = float(np.exp(rng.uniform(-2.5, 2.5)) * rng.choice((-1, 1)))
    (one, other), (damp, damp_other) = np.exp(rng.uniform(-6, 0, 2)), np.exp(rng.uniform(-6, -2, 2))
    (effort, effort_other), mass, arm = rng.uniform(-1, 1, 2), rng.uniform(0.1, 2), rng.uniform(0.05, 0.3)
    across = ("0 1 0", "1 0 0")[seed % 2]

    def hinge(name: str, child: str, axis: str, damping: float) -> str:
        inside = f"<axis><xyz>{axis}</xyz><dynamics><damping>{damping}</damping></dynamics></axis>"
        return f'<joint name="{name}" type="revolute"><parent>base</parent><child>{child}</child>{inside}</joint>'

    sim = _load(
        tmp_path,
        _link("base", "0 0 0 0 0 0", 5.0, 1.0)
        + '<joint name="post" type="fixed"><parent>world</parent><child>base</child></joint>'
        + _link("a", "1 0 0 0 0 0", 1.0, one)
        + _link("b", "2 0 0 0 0 0", mass, other, com=f"0 0 {-arm}")
        + hinge("ja", "a", "0 1 0", damp)
        + hinge("jb", "b", across, damp_other)
        + f"""<joint name="mesh" type="gearbox"><parent>a</parent><child>b</child><axis><xyz>0 1 0</xyz></axis>
        <axis2><xyz>{across}</xyz></axis2><gearbox_ratio>{ratio}</gearbox_ratio>
        <gearbox_reference_body>base</gearbox_reference_body></joint>""",
    )
    driver, driven = sim["m"].joint("ja"), sim["m"].joint("jb")
    driver.command_effort(float(effort))
    driven.command_effort(float(effort_other))
    sim.run(1.0)

    def motion(_time: float, state: _Array) -> _Array:
        angle, rate = state
        load = effort_other + damp_other * ratio * rate + mass * G * arm * math.sin(ratio * angle)
        return np.array((rate, (effort - damp * rate - ratio * load) / (one + ratio**2 * (other + mass * arm**2))))

    angle, rate = _integrated(motion, np.zeros(2), 1.0)
    assert driver.position == pytest.approx(angle, rel=3e-3, abs=1e-4)
    assert driver.velocity == pytest.approx(rate, rel=3e-3, abs=1e-3)
    assert driven.position == pytest.approx(-ratio * driver.position, abs=1e-5)


@pytest.mark.parametrize("seed", range(4))
def test_a_lift_carries_its_load(tmp_path: Path, seed: int) -> None:
    """(M + m) z'' = F − (M + m) g − c z', and the load stands on the car."""
    rng = np.random.default_rng(seed)
    car, load, damping = 10 ** rng.uniform(0, 3), 10 ** rng.uniform(-1, 2), 10 ** rng.uniform(0, 3)
    force = (car + load) * G * rng.uniform(0.8, 1.2)
    box = '<collision name="c"><geometry><box><size>{0}</size></box></geometry></collision>'
    cargo = _link("cargo", "0.1 0.2 0.15 0 0 0.4", load, load * 0.01, more=box.format("0.2 0.2 0.2"))
    sim = _load(
        tmp_path,
        _link("car", "0 0 0 0 0 0", car, car * 0.1, more=box.format("1 1 0.1"))
        + f"""<joint name="lift" type="prismatic"><parent>world</parent><child>car</child><axis><xyz>0 0 1</xyz>
        <dynamics><damping>{damping}</damping></dynamics></axis></joint>""",
        ground=f'<model name="load">{cargo}</model>',
    )
    lift = sim["m"].joint("lift")
    lift.command_effort(float(force))
    sim.run(2.0)
    rate = damping / (car + load)
    final = (force / (car + load) - G) / rate
    height = final * (2.0 - (1.0 - math.exp(-rate * 2.0)) / rate)
    assert lift.velocity == pytest.approx(final * (1.0 - math.exp(-rate * 2.0)), rel=5e-3, abs=1e-3)
    assert lift.position == pytest.approx(height, rel=5e-3, abs=1e-3)
    x, y, z = sim["load"].link("cargo").pose.position
    assert (x, y, z - lift.position) == pytest.approx((0.1, 0.2, 0.15), abs=2e-3)
