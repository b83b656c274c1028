"""Result of a run: measures by the plan's Python functions, and its criteria."""

import math
import runpy
from collections.abc import Callable, Mapping

from trundle.base.diagnostics import UsageError
from trundle.sim.simulation import Simulation

from .plan import Measure, Plan
from .row_result import RowResult
from .rows import Row
from .state_names import StateExpressions, named_values


class Judge:
    """Functions and criteria of a plan."""

    def __init__(self, plan: Plan, expressions: StateExpressions) -> None:
        self._plan = plan
        self._expressions = expressions
        self._functions: dict[str, Callable[..., object]] = {}

    def check(self, row: Row, start_measures: Mapping[str, float | str | None]) -> None:
        """Check all functions and criteria with the measures at a run's start.

        Raises:
            UsageError: a function or criterion is invalid, with its line.
        """
        measures = {item.name: start_measures.get(item.name) or 0.0 for item in self._plan.measures}
        for formula in self._plan.criteria:
            self._expressions.evaluate(formula, named_values(row.values) | measures)
        for measure in self._plan.measures:
            if measure.function is not None:
                self._function(measure)

    def call_functions(self, simulation: Simulation) -> dict[str, float | str | None]:
        """Return the measures by Python functions.

        Raises:
            UsageError: a function raised an exception, or returned no number.
        """
        measures: dict[str, float | str | None] = {}
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
            measures[measure.name] = float(value)
        return measures

    def _function(self, measure: Measure) -> Callable[..., object]:
        assert measure.function is not None
        if measure.name not in self._functions:
            file, name = measure.function
            try:
                function = runpy.run_path(str(file)).get(name)
            except Exception as error:  # a user's code may raise anything
                raise UsageError(f"{measure.at}: error: {file}: {type(error).__name__}: {error}") from None
            if not callable(function):
                raise UsageError(f"{measure.at}: error: {file} has no function {name!r}")
            self._functions[measure.name] = function
        return self._functions[measure.name]

    def judged(self, row: Row, time_s: float, measures: dict[str, float | str | None], note: str) -> RowResult:
        """Return the result of a completed run.

        Args:
            row: row of the run.
            time_s: simulation time at the end [s].
            measures: name → measured value; None: not measured.
            note: remark on a result that meets all criteria, such as the run's warnings; may be empty.

        Raises:
            UsageError: a criterion cannot be evaluated, with its line.
        """
        names = named_values(row.values) | dict(measures)
        for formula in self._plan.criteria:
            mentioned = {name: value for name, value in measures.items() if name in formula.text}
            try:
                is_met = bool(self._expressions.evaluate(formula, names))
            except UsageError:
                if None not in mentioned.values():
                    raise
                is_met = False
            if not is_met:
                numbers = [f"{name} = {_number(value)}" for name, value in mentioned.items()]
                return RowResult(row.number, "failed", f"not {formula.text}: {', '.join(numbers)}", time_s, measures)
        return RowResult(row.number, "ok", note, time_s, measures)


def _number(value: float | str | None) -> str:
    return "none" if value is None else value if isinstance(value, str) else f"{value:.6g}"
