"""One, ten and fifty RP2Ws: simulation of the SDF against a hand-written MuJoCo model with MuJoCo's defaults.

Times are of this process' CPU, which depends least on other programs. The cost of a robot must not grow with the
number of robots: rows "one of N" give the cost per robot, against that of one robot alone.
"""

import resource
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import mujoco
from msgspec.structs import replace

import trundle
from bench.loop import bare_loop, cpu_rate
from bench.table import Row
from trundle.base.diagnostics import Diagnostics
from trundle.sim.renderers import RENDERERS
from trundle.sim.sensors import MountedSensors
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose

ROBOT = Path(__file__).parents[1] / "examples/rp2w"
_COUNTS = (1, 10, 50)
_GAZEBO = {1: 10_208, 10: 1_168, 50: 188}
"""Steps per second of Gazebo 11.1 on two cores of another machine, with the same number of rolling robots."""
_PAIRS = 15
_SPEED = 2.0
"""Speed of driven wheels [rad/s]."""
_BOXES = (
    ("body", "chassis", "0.2032 0.19685 0.0635", "0 0.1651 -0.6858", "1 0 0 0"),
    ("body", "board", "0.1397 0.098425 0.00005", "0 0.11427 0.2253", "0.98481 -0.17365 0 0"),
    ("base", "bottom", "0.04445 0.04445 0.00005", "0 0 0", "1 0 0 0"),
    ("base", "height", "0.03175 0.03175 0.01905", "0 0.01905 0", "1 0 0 0"),
)


def run() -> list[Row]:
    """Alternate simulation and peer, so that a varying machine speed affects both equally."""
    rows: list[Row] = []
    costs: dict[tuple[str, int], float] = {}
    for motion, max_rolling in (("at rest", 0), ("of which one rolls", 1), ("rolling", _COUNTS[-1])):
        for count in _COUNTS:
            steps, rolling = 8_000 // count, min(max_rolling, count)
            if motion == "of which one rolls" and count == 1:
                continue
            sim, peer = rolling_robots(count, rolling=rolling), _by_hand(count, rolling=rolling)
            sim.step(1024)
            peer(1024)
            pairs = [(cpu_rate(sim.step, steps), cpu_rate(peer, steps)) for _ in range(_PAIRS)]
            value = statistics.median(a for a, _ in pairs)
            ratio = statistics.median(a / b for a, b in pairs)
            rows.append(Row(f"{count} RP2W {motion}", value, "steps/s", "MuJoCo by hand", ratio))
            costs[motion, count] = 1e6 / (value * count)
            if rolling == count:
                rows.append(_bare_loop_row(sim, count, steps))
    for (motion, count), cost in costs.items():
        if (motion, 1) not in costs:
            continue
        ratio = cost / costs[motion, 1]
        rows.append(Row(f"one of {count} RP2W {motion}", cost, "µs a step", "one alone", ratio))
    max_count = _COUNTS[-1]
    rows.append(_with_cameras(max_count))
    start = time.process_time()
    rolling_robots(max_count, rolling=0).step(1)
    elapsed_s = time.process_time() - start
    _by_hand(max_count, rolling=0)(1)
    ratio = elapsed_s / (time.process_time() - start - elapsed_s)
    rows.append(Row(f"{max_count} RP2W, from the SDF to the first step", elapsed_s, "CPU s", "MuJoCo by hand", ratio))
    code = f"from bench.robots import print_peak; print_peak({max_count})"
    process = subprocess.run(
        [sys.executable, "-c", code], cwd=ROBOT.parents[1], capture_output=True, text=True, check=True
    )
    peak = float(process.stdout)
    rows.append(Row(f"{max_count} RP2W, peak memory", peak, "MB", "Gazebo 11's 612 MB", peak / 612))
    return rows


def print_peak(count: int) -> None:
    """Simulate robots for two seconds, and print the peak resident memory of this process [MB]."""
    rolling_robots(count, rolling=count).step(2000)
    print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)


def _bare_loop_row(sim: Simulation, count: int, steps: int) -> Row:
    loop = bare_loop(sim)
    pairs = [(cpu_rate(sim.step, steps), cpu_rate(loop, steps)) for _ in range(_PAIRS)]
    value, ratio = statistics.median(a for a, _ in pairs), statistics.median(a / b for a, b in pairs)
    return Row(f"the same {count} (Gazebo 11: {_GAZEBO[count]:,})", value, "steps/s", "mj_step on the same", ratio)


def _with_cameras(count: int) -> Row:
    """Compare robots with always-on cameras without a reader to robots without cameras."""
    plain, equipped = rolling_robots(count, rolling=count), rolling_robots(count, rolling=count)
    MountedSensors(equipped, RENDERERS["cpu"]).start()
    for sim in (plain, equipped):
        sim.step(1024)
    pairs = [(cpu_rate(equipped.step, 200), cpu_rate(plain.step, 200)) for _ in range(_PAIRS)]
    value, ratio = statistics.median(a for a, _ in pairs), statistics.median(a / b for a, b in pairs)
    name = f"{count} RP2W rolling, {2 * count} cameras without a reader"
    return Row(name, value, "steps/s", "the same without cameras", ratio)


def rolling_robots(count: int, *, rolling: int) -> Simulation:
    """Return a simulation of RP2Ws on a plane, of which `rolling` drive forward."""
    alone = trundle.load(str(ROBOT)).world
    robot = replace(next(m for m in alone.models if not m.static), plugins=())
    robots = [
        replace(robot, name=f"r{i}", world_from_model=Pose((2.0 * (i % 10), 2.0 * (i // 10), 0.0)))
        for i in range(count)
    ]
    ground = [model for model in alone.models if model.static]
    sim = Simulation(replace(alone, models=(*robots, *ground)), Diagnostics())
    for name in (r.name for r in robots[:rolling]):
        for wheel in ("chassis_left_wheel", "chassis_right_wheel"):
            sim[name].joint(wheel).command_velocity(_SPEED, max_effort=2.0)
    return sim


def _by_hand(count: int, *, rolling: int) -> Callable[[int], None]:
    robots = "".join(_mjcf(i, 2.0 * (i % 10), 2.0 * (i // 10)) for i in range(count))
    names = ("body", "base", "camera", "left", "right", "front")
    excludes = "".join(
        f'<exclude body1="{a}{i}" body2="{b}{i}"/>'
        for i in range(count)
        for n, a in enumerate(names)
        for b in names[n + 1 :]
    )
    motors = "".join(
        f'<velocity joint="{side}{i}" kv="5" forcerange="-2 2" forcelimited="true"/>'
        for i in range(rolling)
        for side in ("left", "right")
    )
    model = mujoco.MjModel.from_xml_string(
        '<mujoco><compiler autolimits="true"/><option timestep="0.001" gravity="0 0 -9.8"/>'
        f'<worldbody><geom type="plane" size="0 0 1"/>{robots}</worldbody><contact>{excludes}</contact>'
        + (f"<actuator>{motors}</actuator>" if rolling else "")
        + "</mujoco>"
    )
    data = mujoco.MjData(model)
    data.ctrl[:] = _SPEED
    return lambda steps: mujoco.mj_step(model, data, nstep=steps)


def _mjcf(i: int, x: float, y: float) -> str:
    """Return the MJCF of one robot; as in its SDF, every link has a moment of inertia of 1 on each axis."""

    def mass(kilograms: float, moment: float = 1.0) -> str:
        return f'<inertial pos="0 0 0" mass="{kilograms}" diaginertia="{moment} {moment} {moment}"/>'

    def boxes(body: str) -> str:
        return "".join(
            f'<geom type="box" size="{size}" pos="{pos}" quat="{quat}"/>'
            for b, _, size, pos, quat in _BOXES
            if b == body
        )

    def wheel(name: str, pos: str, radius: float, half: float, loss: float) -> str:
        return (
            f'<body name="{name}{i}" pos="{pos}"><joint name="{name}{i}" axis="1 0 0" frictionloss="{loss}"/>'
            f'{mass(0.5)}<geom type="cylinder" size="{radius} {half}" quat="0.70711 0 0.70711 0"/></body>'
        )

    wheels = (
        wheel("left", "-0.1524 0.2413 -0.7112", 0.0635, 0.01905, 0.3)
        + wheel("right", "0.1524 0.2413 -0.7112", 0.0635, 0.01905, 0.3)
        + wheel("front", "0 0 -0.6985", 0.0762, 0.0254, 0.0)
    )
    camera = f'<body name="camera{i}" pos="0 0.01905 0.1113"><joint axis="1 0 0" range="-90 90"/>{mass(0.005)}</body>'
    base = f'<body name="base{i}" pos="0 0 0.6253"><joint axis="0 0 1"/>{mass(0.005)}{boxes("base")}{camera}</body>'
    pole = '<geom type="cylinder" size="0.0381 0.6223"/>'
    return (
        f'<body name="body{i}" pos="{x} {y + 0.0381} 0.7747"><freejoint/>{mass(4.5, 2.0)}{pole}{boxes("body")}'
        f"{base}{wheels}</body>"
    )
