"""A sweep of the RP2W with varied mass, friction and push, against the engine's bare loop on the same models.

Two processes run in parallel; each alternates a row and its peer, so that a varying machine speed affects both
equally. Kinematic trees sleep in both at the same times, or never. Times are of CPU, which depends least on other
programs.
"""

import statistics
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from itertools import pairwise
from multiprocessing import get_context
from pathlib import Path

import mujoco

import trundle
from bench.table import Row
from trundle.sim.physics.step.sleeping import DECISION_PERIOD, SleepPolicy
from trundle.sim.simulation import Simulation
from trundle.studies.sweep.plan_reader import read_plan
from trundle.studies.sweep.row_runner import RowRunner
from trundle.studies.sweep.rows import Rows

_RUNS = 1000
"""Rows of the table whose size is measured."""
_SIMULATED = 64
"""Rows that are simulated in full."""
_PROCESSES = 2
_PEER = f"mj_step(nstep=…) in {_PROCESSES} processes, with the same sleep"
_DURATION_S = 10.0
_PUSH_S = (1.0, 1.3)
_PLAN = """\
world: model://rp2w
duration: {duration}
samples: {rows}
design: latin_hypercube
vary:
  models/rp2w/links/chassis/inertial/mass: {{uniform: [2, 5]}}
  mu: {{log_uniform: [0.1, 1]}}
  push: {{uniform: [5, 30]}}
set: {{models/rp2w/links/*/collisions/*/friction: mu, models/rp2w/allow_auto_disable: {sleeps}}}
events: [{{at: {push_s[0]}, push: rp2w/chassis, force: [push, 0, 0], for: {push_for_s:.1f}}}]
measure: {{moved: models.rp2w.x}}
"""


def run() -> list[Row]:
    """Run the simulated rows without and with sleep, and the whole table."""
    rows: list[Row] = []
    for sleeps, mode in ((False, "no sleep"), (True, "sleeping at rest")):
        parts = [range(i, _SIMULATED, _PROCESSES) for i in range(_PROCESSES)]
        with ProcessPoolExecutor(_PROCESSES, mp_context=get_context("spawn")) as pool:
            pairs = [pair for part in pool.map(_pairs, parts, [sleeps] * _PROCESSES) for pair in part]
        rate = statistics.median(sweep for sweep, _ in pairs)
        ratio = statistics.median(sweep / bare for sweep, bare in pairs)
        rows.append(Row(f"sweep of RP2W, 10 s runs with a push, {mode}", rate, "steps/s", _PEER, ratio))
    owner_ms, size = _table()
    return [
        *rows,
        Row("start of a row of a sweep", _start_ms(), "ms", "", None),
        Row("a row of a sweep, in the process that collects them", owner_ms, "ms", "", None),
        Row("results of a sweep, 4 measured numbers", size, "bytes/row", "", None),
    ]


def _plan(rows: int, *, sleeps: bool, duration_s: float = _DURATION_S) -> str:
    push_for_s = _PUSH_S[1] - _PUSH_S[0]
    return _PLAN.format(rows=rows, sleeps=sleeps, duration=duration_s, push_s=_PUSH_S, push_for_s=push_for_s)


def _runner(*, sleeps: bool) -> tuple[Rows, RowRunner]:
    plan = read_plan(_plan(_SIMULATED, sleeps=sleeps), file="bench.yaml", folder=Path.cwd())
    return Rows(plan), RowRunner(plan)


def _pairs(numbers: range, sleeps: bool) -> list[tuple[float, float]]:
    """Return the steps per CPU second of rows in a worker, and of MuJoCo alone."""
    rows, runner = _runner(sleeps=sleeps)
    runner.run(rows.row(numbers[0]))
    pairs: list[tuple[float, float]] = []
    for number in numbers:
        row = rows.row(number)
        start = time.process_time()
        runner.run(row)
        row_s = time.process_time() - start
        with runner.start(row) as run:
            steps, bare_s = _bare_run(run.simulation, float(str(row.values["push"])))
        pairs.append((steps / row_s, steps / bare_s))
    return pairs


def _bare_run(simulation: Simulation, push: float) -> tuple[int, float]:
    """Step a row's model to its end with the engine's sleep policy; return steps and CPU time [s]."""
    compiled = simulation.engine.compiled
    model, data = compiled.model, mujoco.MjData(compiled.model)
    policy, chassis = SleepPolicy(compiled, data), model.body("rp2w::chassis").id
    pushed, freed, steps = (round(seconds / model.opt.timestep) for seconds in (*_PUSH_S, _DURATION_S))
    ends = sorted({*range(0, steps, DECISION_PERIOD), pushed, freed, steps})
    start = time.process_time()
    for first, end in pairwise(ends):
        data.xfrc_applied[chassis, 0] = push if pushed <= first < freed else 0.0
        mujoco.mj_step(model, data, nstep=end - first)
        if end % DECISION_PERIOD == 0:
            policy.update()
    return steps, time.process_time() - start


def _start_ms() -> float:
    """Return the CPU time of creating a row's simulation [ms], without reading the world."""
    rows, runner = _runner(sleeps=True)
    starts: list[float] = []
    for row in rows:
        start = time.process_time()
        runner.start(row).close()
        starts.append(time.process_time() - start)
    return statistics.median(starts) * 1000


def _table() -> tuple[float, float]:
    """Sweep short rows; return the CPU time of this process [ms] and the size of the results, per row."""
    with tempfile.TemporaryDirectory() as folder:
        plan = Path(folder) / "plan.yaml"
        plan.write_text(_plan(_RUNS, sleeps=True, duration_s=0.01))
        start = time.process_time()
        trundle.sweep(plan)
        owner_s = time.process_time() - start
        return 1000 * owner_s / _RUNS, (Path(folder) / "plan.sweep/results.parquet").stat().st_size / _RUNS
