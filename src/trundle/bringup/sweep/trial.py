"""Runs of single rows: the row's world, its events, its result."""

import math
import os
import runpy
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path

from trundle.diagnostics import DescriptionError, Diagnostics, TrundleError, UsageError
from trundle.packages import Packages
from trundle.physics import Recompiler
from trundle.spatial import NS_PER_S
from trundle.trials import ARGUMENTS, Formula, Measure, Plan, Row, RowResult, Rows, Value, with_property

from ..loaded_simulation import LoadedSimulation
from ..world_setup import LoadedWorld, load_world
from .script import RunScript
from .state_names import StateExpressions

_MAX_WORLDS = 8
"""Most worlds kept, one for each set of xacro arguments."""


class TrialSimulation(LoadedSimulation):
    """Simulation of one row, in which its events happen."""

    script: RunScript

    def advance(self, until_ns: int) -> None:
        """See `Simulation.advance`; the simulation ends where a stop condition is true."""
        while self.time_ns < until_ns and not self.script.is_over:
            due_ns = self.script.next_ns
            if due_ns is not None and due_ns <= self.time_ns:
                self.script.act()
            else:
                super().advance(until_ns if due_ns is None else min(due_ns, until_ns))


class TrialRunner:
    """Runs rows of a plan one after the other; worlds are read once and compiled models kept."""

    def __init__(self, plan: Plan) -> None:
        self._plan = plan
        self._expressions = StateExpressions()
        self._worlds: dict[tuple[tuple[str, str], ...], LoadedWorld] = {}
        self._compiler = Recompiler()
        self._functions: dict[str, Callable[..., object]] = {}

    def run(self, row: Row) -> RowResult:
        """Run a row to its end; what goes wrong is in its result."""
        time_s: float | None = None
        try:
            with self.simulation(row) as simulation:
                try:
                    simulation.advance(round(self._plan.duration_s * NS_PER_S))
                finally:
                    time_s = simulation.time_ns / NS_PER_S
                measures = simulation.script.measures() | self._call_functions(simulation)
                return self._judged(row, RowResult(row.number, time=time_s, measures=measures), simulation.report)
        except TrundleError as error:
            return RowResult(row.number, "error", str(error), time_s)

    def check(self, row: Row) -> None:
        """Evaluate everything once at the start of a row.

        Raises:
            TrundleError: the plan cannot be run; with its line.
        """
        with self.simulation(row) as simulation:
            found = simulation.script.measures()
            measures = {each.name: found.get(each.name) or 0.0 for each in self._plan.measures}
            for formula in self._plan.criteria:
                self._expressions.evaluate(formula, self._values(row) | measures)
            for measure in self._plan.measures:
                if measure.function is not None:
                    self._function(measure)

    def simulation(self, row: Row) -> "TrialSimulation":
        """Return the simulation of a row at time zero, with its events.

        Raises:
            TrundleError: its world cannot be read or simulated.
        """
        report = Diagnostics()
        stage = self.stage(row)
        compiled = self._compiler.compile(stage.world, report)
        simulation = TrialSimulation(stage, report, seed=row.seed, compiled=compiled)
        simulation.script = RunScript(self._plan, row, simulation, self._expressions)
        if self._plan.plugins:
            simulation.load_plugins(dict(os.environ))
        return simulation

    def stage(self, row: Row) -> LoadedWorld:
        """Return the world of a row.

        Raises:
            TrundleError: it cannot be read, or has no such property.
        """
        arguments, properties = self._assigned(row)
        base = self._base(arguments)
        world = base.world
        for path, (value, at) in properties.items():
            try:
                world = with_property(world, path, value)
            except UsageError as error:
                raise UsageError(f"{at}: error: {error}") from None
        return replace(base, world=world)

    def _assigned(self, row: Row) -> tuple[dict[str, str], dict[str, tuple[Value, object]]]:
        """Return the xacro arguments of a row, and its properties with their line in the plan."""
        assigned: dict[str, tuple[Value, object]] = {
            each.name: (row.values[each.name], each.at) for each in self._plan.vary if "/" in each.name
        }
        names = self._values(row)
        for path, formula in self._plan.assignments.items():
            value = self._expressions.evaluate(formula, names)
            assigned[path] = (_plain(value, formula), formula.at)
        prefix = f"{ARGUMENTS}/"
        arguments = {path: _text(value) for path, (value, _) in assigned.items() if path.startswith(prefix)}
        properties = {path: found for path, found in assigned.items() if path not in arguments}
        return {path.removeprefix(prefix): value for path, value in arguments.items()}, properties

    def _base(self, arguments: Mapping[str, str]) -> LoadedWorld:
        key = tuple(sorted(arguments.items()))
        found = self._worlds.pop(key, None)
        if found is None:
            packages = Packages(dict(os.environ), start=Path.cwd())
            try:
                found = load_world(self._plan.world, packages, Diagnostics(), seed=self._plan.seed, arguments=arguments)
            except DescriptionError:
                raise
            except UsageError as error:
                raise DescriptionError(self._plan.world_at, str(error)) from None
        self._worlds[key] = found
        if len(self._worlds) > _MAX_WORLDS:
            del self._worlds[next(iter(self._worlds))]
        return found

    def _values(self, row: Row) -> dict[str, object]:
        return {name: value for name, value in row.values.items() if "/" not in name}

    def _call_functions(self, simulation: LoadedSimulation) -> dict[str, float | str | None]:
        """Return what the plan's Python functions measure.

        Raises:
            UsageError: one raised an exception, or returned no number.
        """
        found: dict[str, float | str | None] = {}
        for measure in self._plan.measures:
            if measure.function is None:
                continue
            try:
                value = self._function(measure)(simulation)
            except UsageError:
                raise
            except Exception as error:  # a user's code may raise anything
                raise UsageError(f"{measure.at}: error: {measure.name}: {type(error).__name__}: {error}") from None
            if not isinstance(value, int | float) or not math.isfinite(value):
                raise UsageError(f"{measure.at}: error: {measure.name} must return a finite number, not {value!r}")
            found[measure.name] = float(value)
        return found

    def _function(self, measure: Measure) -> Callable[..., object]:
        assert measure.function is not None
        if measure.name not in self._functions:
            file, name = measure.function
            try:
                found = runpy.run_path(str(file)).get(name)
            except Exception as error:  # a user's code may raise anything
                raise UsageError(f"{measure.at}: error: {file}: {type(error).__name__}: {error}") from None
            if not callable(found):
                raise UsageError(f"{measure.at}: error: {file} has no function {name!r}")
            self._functions[measure.name] = found
        return self._functions[measure.name]

    def _judged(self, row: Row, result: RowResult, report: Diagnostics) -> RowResult:
        """Return the result with the first criterion that it does not meet, and what physics mended."""
        names = self._values(row) | dict(result.measures)
        for formula in self._plan.criteria:
            if not self._expressions.evaluate(formula, names):
                numbers = [f"{name} = {value:.6g}" for name, value in _mentioned(formula, result.measures).items()]
                reason = f"not {formula.text}: {', '.join(numbers)}"
                return RowResult(result.row, "failed", reason, result.time, result.measures)
        return RowResult(result.row, "ok", "; ".join(report.warnings), result.time, result.measures)


def run_row(plan: Plan) -> Callable[[int], RowResult]:
    """Return the function that runs a row of a plan by its number."""
    rows, runner = Rows(plan), TrialRunner(plan)
    return lambda number: runner.run(rows.row(number))


def _mentioned(formula: Formula, measures: Mapping[str, float | str | None]) -> dict[str, float]:
    return {name: value for name, value in measures.items() if name in formula.text and isinstance(value, float)}


def _plain(value: object, formula: Formula) -> Value:
    if isinstance(value, list | tuple):
        return tuple(_plain(each, formula) for each in value)
    if not isinstance(value, bool | int | float | str):
        raise UsageError(f"{formula.at}: error: {formula.text} must be a number, a text or a list, and is {value!r}")
    return value


def _text(value: Value) -> str:
    """Return a value as a xacro argument."""
    return str(value).lower() if isinstance(value, bool) else str(value)
