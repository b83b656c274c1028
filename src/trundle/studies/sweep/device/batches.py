"""Batches of rows on a GPU, many worlds in one process."""

from collections.abc import Callable, Iterator
from itertools import islice

import numpy as np

from trundle.base.diagnostics import TrundleError
from trundle.base.workers import Progress
from trundle.sim.physics import GpuWorlds
from trundle.spatial import NS_PER_S

from ..plan import Plan
from ..row_result import RowResult
from ..row_runner import RowRunner
from ..rows import Rows
from .device_row import DeviceRow
from .row_check import incompatibility

_BATCH_ROWS = 1024
"""Maximum worlds in a batch; each takes up to a megabyte of main memory."""
_MAX_STEPS = 1000
"""Maximum steps between two polls of `is_ending`."""


def run_on_gpu(
    plan: Plan,
    numbers: Iterator[int],
    receive: Callable[[RowResult], object],
    *,
    gpu: str,
    progress: Progress,
    is_ending: Callable[[], bool],
) -> None:
    """Run rows and show their progress.

    Args:
        plan: plan accepted by `check_plan` and `check_worlds`.
        numbers: row numbers.
        receive: called with each result.
        gpu: Warp's name of the GPU.
        progress: progress of the sweep, closed at the end.
        is_ending: polled; True ends the runs.
    """
    batches = _Batches(plan, gpu)
    try:
        while not is_ending() and (some := list(islice(numbers, _BATCH_ROWS))):
            for result in batches.run(some, is_ending):
                if result is not None:
                    progress.add(is_ok=result.status == "ok")
                    receive(result)
                progress.show()
    finally:
        progress.close()


class _Batches:
    """Batches of worlds that are compatible with the first row's."""

    def __init__(self, plan: Plan, gpu: str) -> None:
        self._rows, self._runner, self._gpu = Rows(plan), RowRunner(plan), gpu
        self._until_ns = round(plan.duration_s * NS_PER_S)
        self._first = self._runner.start(self._rows.row(0)).simulation

    def run(self, numbers: list[int], is_ending: Callable[[], bool]) -> Iterator[RowResult | None]:
        """Yield the results of rows as they complete, and None in between."""
        runs: list[DeviceRow] = []
        for number in numbers:
            started = self._start(number)
            if isinstance(started, DeviceRow):
                runs.append(started)
            else:
                yield started
        if runs:
            yield from self._step(runs, is_ending)

    def _start(self, number: int) -> DeviceRow | RowResult:
        row = self._rows.row(number)
        try:
            run = self._runner.start(row)
        except TrundleError as error:
            return RowResult(number, "error", str(error))
        reason = incompatibility(self._first, run.simulation)
        if reason:
            return RowResult(number, "error", f"a GPU cannot step this run beside the first, because {reason}")
        return DeviceRow(row, run, self._runner, until_ns=self._until_ns)

    def _step(self, runs: list[DeviceRow], is_ending: Callable[[], bool]) -> Iterator[RowResult | None]:
        worlds, step = GpuWorlds([run.simulation.engine for run in runs], self._gpu), 0
        running = runs
        while not is_ending():
            for run in running:
                run.act()
            yield from (run.result for run in running if run.result is not None)
            running = [run for run in running if run.result is None]
            if not running:
                return
            count = min(min(run.next_step for run in running) - step, _MAX_STEPS)
            results = worlds.step(count, chosen=np.array([run.result is None for run in runs]))
            step += count
            for run, result in zip(runs, results, strict=True):
                if run.result is None:
                    run.arrive(step, result)
            yield from (run.result for run in running)
            running = [run for run in running if run.result is None]
