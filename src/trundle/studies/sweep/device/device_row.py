"""Run of one row, whose physics is stepped together with other rows'."""

from trundle.base.diagnostics import TrundleError
from trundle.sim.physics import StepResult
from trundle.spatial import NS_PER_S

from ..row_result import RowResult
from ..row_runner import RowRun, RowRunner
from ..rows import Row

_WHY = {
    StepResult.UNSTABLE: "the physics became unstable {}; a smaller <max_step_size> or more plausible masses and "
    "inertias may help",
    StepResult.CROWDED: "it has more contacts than the GPU has room for {}; device='cpu' has no such bound",
}


class DeviceRow:
    """Run that performs its events between steps, as `RowRun.advance`."""

    def __init__(self, row: Row, run: RowRun, runner: RowRunner, *, until_ns: int) -> None:
        """Wrap a run at time zero.

        Args:
            row: row of the run.
            run: run with its events.
            runner: runner that computes the result.
            until_ns: end time [ns].
        """
        self.simulation = run.simulation
        self.result: RowResult | None = None
        """None while it runs."""
        self._row, self._run, self._runner, self._until_ns = row, run, runner, until_ns

    @property
    def next_step(self) -> int:
        """Step of the next event or sample, expiry of a load, or end of the run."""
        due_ns = self._run.script.next_ns
        stop_ns = self._until_ns if due_ns is None else min(due_ns, self._until_ns)
        return min([-(-stop_ns // self.simulation.step_ns), *self.simulation.loads.expiry_steps()])

    def act(self) -> None:
        """Perform the events and samples due now; at the end, compute the result."""
        simulation, script = self.simulation, self._run.script
        try:
            while simulation.time_ns < self._until_ns and not script.is_over:
                if script.next_ns is None or script.next_ns > simulation.time_ns:
                    return
                script.act()
        except TrundleError as error:
            self._fail(str(error))
            return
        self.result = self._runner.result(self._row, self._run)

    def arrive(self, step: int, result: StepResult) -> None:
        """Set the step that physics has reached; an unstable run ends with an error."""
        if result is StepResult.STABLE:
            self.simulation.set_step(step)
            return
        start_s, end_s = self.simulation.time_ns / NS_PER_S, step * self.simulation.step_ns / NS_PER_S
        self._fail(_WHY[result].format(f"between {start_s:g} and {end_s:g} s"))

    def _fail(self, why: str) -> None:
        self.result = RowResult(self._row.number, "error", why, self.simulation.time_ns / NS_PER_S)
