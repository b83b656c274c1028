"""A sweep of the RP2W with varied mass, friction and push, against the engine's bare loop on the same models.

Two processes work at once, each of which runs a row and then its peer, so that both see the machine at its fast and
slow moments. Trees sleep alike on both sides: never, or by the same decisions. Times are of CPU, which others on the
machine change least.
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
_PEER = f"mj_step(nstep=…) in {_PROCESSES} processes, sleeping alike"
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
    """Run the simulated rows without sleep and with it, and the whole table."""
    rows: list[Row] = []
    for sleeps, what in ((False, "nothing sleeps"), (True, "sleeping at rest")):
        parts = [range(i, _SIMULATED, _PROCESSES) for i in range(_PROCESSES)]
        with ProcessPoolExecutor(_PROCESSES, mp_context=get_context("spawn")) as pool:
            pairs = [pair for part in pool.map(_pairs, parts, [sleeps] * _PROCESSES) for pair in part]
        rate = statistics.median(ours for ours, _ in pairs)
        ratio = statistics.median(ours / bare for ours, bare in pairs)
        rows.append(Row(f"sweep of RP2W, 10 s runs with a push, {what}", rate, "steps/s", _PEER, ratio))
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
    """Return the steps per CPU second of some rows as a worker runs them, and of MuJoCo alone."""
    rows, runner = _runner(sleeps=sleeps)
    runner.run(rows.row(numbers[0]))
    pairs: list[tuple[float, float]] = []
    for number in numbers:
        row = rows.row(number)
        began = time.process_time()
        runner.run(row)
        ours_s = time.process_time() - began
        with runner.start(row) as run:
            steps, bare_s = _bare_run(run.simulation, float(str(row.values["push"])))
        pairs.append((steps / ours_s, steps / bare_s))
    return pairs


def _bare_run(simulation: Simulation, push: float) -> tuple[int, float]:
    """Step a row's model to its end, deciding on sleep when the engine does; return steps and CPU time [s]."""
    compiled = simulation.engine.compiled
    model, data = compiled.model, mujoco.MjData(compiled.model)
    policy, chassis = SleepPolicy(compiled, data), model.body("rp2w::chassis").id
    pushed, freed, steps = (round(seconds / model.opt.timestep) for seconds in (*_PUSH_S, _DURATION_S))
    ends = sorted({*range(0, steps, DECISION_PERIOD), pushed, freed, steps})
    began = time.process_time()
    for at, end in pairwise(ends):
        data.xfrc_applied[chassis, 0] = push if pushed <= at < freed else 0.0
        mujoco.mj_step(model, data, nstep=end - at)
        if end % DECISION_PERIOD == 0:
            policy.update()
    return steps, time.process_time() - began


def _start_ms() -> float:
    """Return the CPU time of making a row's simulation [ms], without that of reading the world."""
    rows, runner = _runner(sleeps=True)
    starts: list[float] = []
    for row in rows:
        began = time.process_time()
        runner.start(row).close()
        starts.append(time.process_time() - began)
    return statistics.median(starts) * 1000


def _table() -> tuple[float, float]:
    """Sweep short rows; return the CPU time of this process [ms] and the size of the results, per row."""
    with tempfile.TemporaryDirectory() as folder:
        plan = Path(folder) / "plan.yaml"
        plan.write_text(_plan(_RUNS, sleeps=True, duration_s=0.01))
        began = time.process_time()
        trundle.sweep(plan)
        owner_s = time.process_time() - began
        return 1000 * owner_s / _RUNS, (Path(folder) / "plan.sweep/results.parquet").stat().st_size / _RUNS
