"""Rows of docs/physics.md, and measurements of the worlds of examples/physics."""

import math
import os
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import trundle
from trundle.gazebo.model_plugins import load_plugins
from trundle.sim.simulation import ModelHandle, Simulation

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs/physics.md"
WORLDS = ROOT / "examples/physics"
_G = 9.8
_ROW = re.compile(
    r"\| (?P<what>[^|]+) \| `(?P<world>\w+)`, (?P<duration>[\d.]+) s \| `(?P<model>\w+)`(?:'s `(?P<joint>\w+)`)?"
    r" (?P<measure>[a-z ]+?)(?: from (?P<start>[\d.]+) s)?(?: \[[^\]]+\])? \| (?P<truth>[^|]+) \| (?P<gazebo>[^|]+)"
    r" \| (?P<figure>-?[\d.]+) ± (?P<tolerance>[\d.]+) \|"
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """A row of the page's tables."""

    world: str
    duration: float
    """Duration of the run [s]."""
    model: str
    joint: str | None
    measure: str
    start: float
    """Start of the measurement [s]."""
    figure: float
    tolerance: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Trace:
    """Samples of a run: arrays of (n,), except for positions."""

    time: NDArray[np.float64]
    positions: NDArray[np.float64]
    """(n, 3) Positions of the model [m]."""
    yaw: NDArray[np.float64]
    """Yaw of the model, unwrapped [rad]."""
    velocity: NDArray[np.float64]
    """Velocity of the model's first link along x [m/s]."""
    energy: NDArray[np.float64]
    """Energy of links, for frames at the centres of mass and equal moments [J]."""
    joint: NDArray[np.float64]
    """Position of the joint [rad]."""
    rate: NDArray[np.float64]
    """Velocity of the joint [rad/s]."""


def read_rows() -> list[Row]:
    """Read every table of the page."""
    lines = [line for line in PAGE.read_text().splitlines() if re.match(r"\| [^|]+ \| `\w+`, ", line)]
    matches = [_ROW.fullmatch(line) for line in lines]
    assert None not in matches, lines[matches.index(None)]
    return [
        Row(
            world=row["world"],
            duration=float(row["duration"]),
            model=row["model"],
            joint=row["joint"],
            measure=row["measure"],
            start=float(row["start"] or 0.0),
            figure=float(row["figure"]),
            tolerance=float(row["tolerance"]),
        )
        for row in matches
        if row is not None
    ]


def measure(row: Row) -> float:
    """Run the row's world, and return the row's measure."""
    trace = _run(row)
    return MEASURES[row.measure](trace)


def _run(row: Row) -> Trace:
    sim = trundle.load(str(WORLDS / f"{row.world}.world"))
    load_plugins(sim, None, os.environ, log=print)
    steps = round(row.duration * 1e3)
    stride = max(1, steps // 10_000)
    sim.run(row.start)
    model = sim[row.model]
    samples = [_sample(sim, model, row.joint)]
    while sim.time_ns < steps * 1_000_000:
        sim.step(min(stride, steps - sim.time_ns // 1_000_000))
        samples.append(_sample(sim, model, row.joint))
    time, x, y, z, yaw, velocity, energy, joint, rate = np.array(samples).T
    return Trace(
        time=time,
        positions=np.stack([x, y, z], axis=1),
        yaw=np.unwrap(yaw),
        velocity=velocity,
        energy=energy,
        joint=joint,
        rate=rate,
    )


def _sample(sim: Simulation, model: ModelHandle, joint: str | None) -> tuple[float, ...]:
    x, y, z = model.pose.position
    joint_state = (model.joint(joint).position, model.joint(joint).velocity) if joint else (math.nan, math.nan)
    return sim.time_ns * 1e-9, x, y, z, model.pose.rpy[2], model.links[0].twist.linear[0], _energy(model), *joint_state


def _energy(model: ModelHandle) -> float:
    total = 0.0
    for handle, link in zip(model.links, model.model.links, strict=True):
        mass, moment, twist = link.inertial.mass, link.inertial.moments[0], handle.twist
        total += mass * (math.hypot(*twist.linear) ** 2 / 2 + _G * handle.pose.position[2])
        total += moment * math.hypot(*twist.angular) ** 2 / 2
    return total


def _distance(trace: Trace) -> float:
    return float(np.linalg.norm(trace.positions[-1] - trace.positions[0]))


def _elapsed(trace: Trace) -> float:
    return float(trace.time[-1] - trace.time[0])


def _period(trace: Trace) -> float:
    """Return the mean period between the joint's turning points on one side [s]."""
    after = np.flatnonzero((trace.rate[:-1] < 0.0) & (trace.rate[1:] >= 0.0))
    ratio = trace.rate[after] / (trace.rate[after] - trace.rate[after + 1])
    turns = trace.time[after] + ratio * (trace.time[after + 1] - trace.time[after])
    return float((turns[-1] - turns[0]) / (len(turns) - 1))


MEASURES: dict[str, Callable[[Trace], float]] = {
    "x": lambda trace: trace.positions[-1, 0],
    "y": lambda trace: trace.positions[-1, 1],
    "z": lambda trace: trace.positions[-1, 2],
    "highest z": lambda trace: trace.positions[:, 2].max(),
    "lowest z": lambda trace: trace.positions[:, 2].min(),
    "speed along x": lambda trace: trace.velocity[-1],
    "way": _distance,
    "mean speed": lambda trace: _distance(trace) / _elapsed(trace),
    "acceleration": lambda trace: 2 * _distance(trace) / _elapsed(trace) ** 2,
    "yaw": lambda trace: trace.yaw[-1],
    "turning": lambda trace: (trace.yaw[-1] - trace.yaw[0]) / _elapsed(trace),
    "position": lambda trace: trace.joint[-1],
    "furthest": lambda trace: abs(trace.joint).max(),
    "velocity": lambda trace: trace.rate[-1],
    "period": _period,
    "lost energy": lambda trace: trace.energy[0] - trace.energy[-1],
}
"""Name in the page's rows → measure."""
