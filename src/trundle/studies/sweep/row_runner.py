"""Runner of a world plan's rows."""

import os
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Self

from msgspec import Struct

from trundle.base.diagnostics import DescriptionError, Diagnostics, TrundleError, UsageError
from trundle.live.loaded_simulation import LoadedSimulation
from trundle.live.world_setup import LoadedWorld, load_world
from trundle.robots.packages import Packages
from trundle.ros import GraphLoop, StepRecorder
from trundle.sim.physics import Recompiler
from trundle.spatial import NS_PER_S

from .assignments import Assignments, assignments_of
from .judge import Judge
from .launch_row_runner import LaunchRowRunner
from .plan import Plan
from .plan_digest import RunInputs
from .property_path import PARAMETERS
from .row_result import RowResult
from .rows import Row, Rows
from .script import RunScript
from .state_names import StateExpressions
from .topics import TopicReader, topics_of

_MAX_WORLDS = 8
"""Maximum number of cached worlds, one per set of xacro arguments."""
_RECORD_NS = NS_PER_S // 100
"""Resolution of the stamps in bags."""


class RowOutput(Struct, frozen=True):
    """Result of a run, and the bag of its last seconds, if any."""

    result: RowResult
    bag: bytes | None = None


class RowRun:
    """Simulation of one row, with its events."""

    def __init__(self, simulation: LoadedSimulation, script: RunScript, recorder: StepRecorder | None) -> None:
        """Wrap a simulation at time zero; the recorder of its topics is closed with it."""
        self.simulation = simulation
        self.script = script
        self._recorder = recorder

    def advance(self, until_ns: int) -> None:
        """Advance as `Simulation.advance`, at most until a stop condition is true."""
        simulation = self.simulation
        while simulation.time_ns < until_ns and not self.script.is_over:
            due_ns = self.script.next_ns
            if due_ns is not None and due_ns <= simulation.time_ns:
                self.script.act()
                continue
            next_ns = until_ns if due_ns is None else min(due_ns, until_ns)
            if self._recorder is None:
                simulation.advance(next_ns)
            else:
                simulation.advance(min(next_ns, simulation.time_ns + _RECORD_NS))
                self._recorder.write(simulation.time_ns)

    def close(self) -> None:
        """Complete the bag, and leave the ROS graph."""
        if self._recorder is not None:
            self._recorder.close()
        self.simulation.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


class RowRunner:
    """Runner of a plan's rows, one after the other; worlds and compiled models are cached."""

    def __init__(self, plan: Plan) -> None:
        self._plan = plan
        self._expressions = StateExpressions()
        self._judge = Judge(plan, self._expressions)
        self._topics = topics_of(plan)
        self._worlds: dict[tuple[tuple[str, str], ...], LoadedWorld] = {}
        self._compiler = Recompiler()

    def run(self, row: Row) -> RowResult:
        """Run a row to its end; errors are in its result."""
        time_s: float | None = None
        try:
            with self.start(row) as run:
                try:
                    run.advance(round(self._plan.duration_s * NS_PER_S))
                finally:
                    time_s = run.simulation.time_ns / NS_PER_S
                return self.result(row, run)
        except TrundleError as error:
            return RowResult(row.number, "error", str(error), time_s)

    def result(self, row: Row, run: RowRun) -> RowResult:
        """Return the result of a completed run."""
        simulation = run.simulation
        time_s = simulation.time_ns / NS_PER_S
        try:
            measures = run.script.measures() | self._judge.call_functions(simulation)
            return self._judge.judged(row, time_s, measures, "; ".join(simulation.report.warnings))
        except TrundleError as error:
            return RowResult(row.number, "error", str(error), time_s)

    def bag(self, row: Row, result: RowResult) -> bytes | None:
        """Run a row again and return the bag of its last seconds; None if it does not start."""
        assert self._plan.bag_s is not None
        if result.time is None:
            return None
        from_ns = round((result.time - self._plan.bag_s) * NS_PER_S)
        with TemporaryDirectory() as folder:
            file = Path(folder) / "last.bag"
            try:
                with self.start(row, record=file, from_ns=from_ns) as run:
                    run.advance(round(result.time * NS_PER_S))
            except TrundleError:
                pass  # the error is the same as in the run itself
            return file.read_bytes() if file.exists() else None

    def check(self, row: Row) -> list[str]:
        """Check all expressions and events at the start of a row; return the warnings, of which a world has none.

        Raises:
            TrundleError: the plan cannot be run, with its line.
        """
        assigned = assignments_of(self._plan, row, self._expressions)
        for name in assigned.parameters:
            path = f"{PARAMETERS}{name}"
            raise DescriptionError(assigned.sources[path], f"{path}: a world has no ROS parameters; a `launch:` has")
        with self.start(row) as run:
            run.script.check()
            self._judge.check(row, run.script.measures())
        return []

    def start(self, row: Row, *, record: Path | None = None, from_ns: int = 0) -> RowRun:
        """Return the run of a row at time zero, with its events.

        Args:
            row: row to run.
            record: path of the bag of its topics; None: no bag.
            from_ns: time at which the bag begins [ns].

        Raises:
            TrundleError: the world cannot be read or simulated.
        """
        report = Diagnostics()
        loaded = self.load(row)
        compiled = self._compiler.compile(loaded.flat, report)
        environment = {name: value for name, value in os.environ.items() if name != "ROS_MASTER_URI"}
        simulation = LoadedSimulation(loaded, report, environment, seed=row.seed, compiled=compiled)
        recorders: list[StepRecorder] = []

        def start_bag(loop: GraphLoop) -> None:
            if record is not None:
                without_types = self._plan.bag_without
                recorder = StepRecorder(
                    loop, record, on_failure=_leave_out, from_ns=from_ns, without_types=without_types
                )
                recorders.append(recorder)

        try:
            if self._topics or record is not None:
                simulation.open_graph(on_open=start_bag)
            reader = TopicReader(simulation.make_node("/sweep"), self._topics) if self._topics else None
            script = RunScript(self._plan, row, simulation, self._expressions, reader)
            if self._plan.plugins:
                simulation.load_plugins()
        except BaseException:
            simulation.close()
            raise
        return RowRun(simulation, script, next(iter(recorders), None))

    def inputs(self, row: Row) -> RunInputs:
        """Return the inputs of a row.

        Raises:
            TrundleError: the world cannot be read.
        """
        return RunInputs(worlds=(self._assigned_base(assignments_of(self._plan, row, self._expressions)).nested,))

    def load(self, row: Row) -> LoadedWorld:
        """Return the world of a row.

        Raises:
            TrundleError: the world cannot be read, or has no such property.
        """
        assigned = assignments_of(self._plan, row, self._expressions)
        base = self._assigned_base(assigned)
        world = base.flat
        for property_ in assigned.properties:
            world = property_.assigned(world)
        return replace(base, flat=world)

    def _assigned_base(self, assigned: Assignments) -> LoadedWorld:
        with assigned.unknown_arguments_at_plan():
            return self._base(assigned.arguments)

    def _base(self, arguments: Mapping[str, str]) -> LoadedWorld:
        key = tuple(sorted(arguments.items()))
        world = self._worlds.pop(key, None)
        if world is None:
            packages = Packages(dict(os.environ), start=Path.cwd())
            try:
                world = load_world(self._plan.world, packages, Diagnostics(), seed=self._plan.seed, arguments=arguments)
            except DescriptionError:
                raise
            except UsageError as error:
                raise DescriptionError(self._plan.world_at, str(error)) from None
        self._worlds[key] = world
        if len(self._worlds) > _MAX_WORLDS:
            del self._worlds[next(iter(self._worlds))]
        return world


def _leave_out(_why: str) -> None:
    """Ignore the error of a bag that cannot be written; the row's result is valid without it."""


def runner_of(plan: Plan) -> RowRunner | LaunchRowRunner:
    """Return the runner of a plan's rows."""
    return LaunchRowRunner(plan) if plan.is_launch else RowRunner(plan)


def run_row(plan: Plan) -> Callable[[int], RowOutput]:
    """Return a function that runs a row of a plan by its number."""
    rows = Rows(plan)
    runner = runner_of(plan)

    def run(number: int) -> RowOutput:
        row = rows.row(number)
        result = runner.run(row)
        if plan.bag_s is None or result.status == "ok":
            return RowOutput(result)
        return RowOutput(result, runner.bag(row, result))

    return run
