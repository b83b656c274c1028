"""Events, stop conditions and samples of one run.

They are due at the times of the events and at multiples of the sampling period only, so the engine steps in C in
between; a paced run with a page performs them at the same steps.
"""

import math
from collections.abc import Callable
from contextlib import suppress

from trundle.base.diagnostics import UsageError
from trundle.sim.simulation import JointHandle, LinkHandle, Simulation
from trundle.spatial import NS_PER_S, Wrench

from .plan import Event, Formula, Measure, Plan
from .rows import Row
from .state_names import StateExpressions, state_names
from .topics import NoMessageError, TopicReader


class RunScript:
    """Events and measures of one run."""

    def __init__(
        self,
        plan: Plan,
        row: Row,
        simulation: Simulation,
        expressions: StateExpressions,
        topics: TopicReader | None = None,
    ) -> None:
        """Prepare a run at time zero.

        Raises:
            UsageError: invalid number of an event.
        """
        self._topics = topics
        self._plan = plan
        self._values = row.values
        self._simulation = simulation
        self._expressions = expressions
        self._events = sorted((self._event(event) for event in plan.events), key=lambda measure: measure[0])
        self._next_event = 0
        self._sampled = {
            measure.name: (measure, Formula(text=measure.expression, at=measure.at))
            for measure in plan.measures
            if measure.expression is not None
        }
        self._is_sampled = bool(plan.stop) or any(measure.over != "end" for measure, _ in self._sampled.values())
        self._every_ns = max(round(plan.every_s * NS_PER_S), simulation.step_ns)
        self._next_sample_ns = 0 if self._is_sampled else None
        self._values_so_far: dict[str, float] = {}
        self._counts: dict[str, int] = {}
        """Measure → number of its samples."""
        self._sampled_ns: int | None = None
        """Time of the last sample."""
        self.is_over = False
        """True once a stop condition is true."""

    @property
    def next_ns(self) -> int | None:
        """Next time of an event or sample [ns]; None: there is none before the end."""
        times = [time_ns for time_ns, _ in self._events[self._next_event : self._next_event + 1]]
        return min([*times, *([] if self._next_sample_ns is None else [self._next_sample_ns])], default=None)

    def act(self) -> None:
        """Perform the events and samples due now."""
        now_ns = self._simulation.time_ns
        if self._next_sample_ns is not None and self._next_sample_ns <= now_ns:
            self._sample()
            self._next_sample_ns = (now_ns // self._every_ns + 1) * self._every_ns
        for time_ns, do in self._events[self._next_event :]:
            if time_ns <= now_ns:
                self._next_event += 1
                do()

    def restart(self) -> None:
        """Restart after a reset of the simulation."""
        self._next_event, self.is_over = 0, False
        self._next_sample_ns = 0 if self._is_sampled else None
        self._values_so_far.clear()
        self._counts.clear()
        self._sampled_ns = None

    def _names(self) -> dict[str, object]:
        return state_names(self._simulation, self._values, self._topics)

    def _event(self, event: Event) -> tuple[int, Callable[[], None]]:
        """Return an event's time [ns] and action."""
        numbers = [self._expressions.number(formula, self._values) for formula in event.numbers]
        at_s = self._expressions.number(event.time_s, self._values)
        duration_s = None if event.duration_s is None else self._expressions.number(event.duration_s, self._values)
        return round(at_s * NS_PER_S), lambda: self._perform(event, numbers, duration_s)

    def _perform(self, event: Event, numbers: list[float], duration_s: float | None) -> None:
        target = self._target(event)
        if isinstance(target, LinkHandle):
            wrench = Wrench((numbers[0], numbers[1], numbers[2]), (numbers[3], numbers[4], numbers[5]))
            target.apply_wrench(wrench, duration_s=duration_s)
        elif event.kind == "position":
            target.command_position(numbers[0])
        elif event.kind == "velocity":
            target.command_velocity(numbers[0])
        else:
            target.command_effort(numbers[0], duration_s=duration_s)

    def _target(self, event: Event) -> LinkHandle | JointHandle:
        """Return the link or joint of an event.

        Raises:
            UsageError: no such link or joint, with the event's line.
        """
        model, part = event.target
        try:
            handle = self._simulation[model]
            return handle.link(part) if event.kind == "push" else handle.joint(part)
        except UsageError as error:
            raise UsageError(f"{event.at}: error: {error}") from None

    def check(self) -> None:
        """Look up the targets of all events.

        Raises:
            UsageError: no such link or joint, with the event's line.
        """
        for event in self._plan.events:
            self._target(event)

    @property
    def periods_ns(self) -> list[int]:
        """Periods of hooks that call `act` at all times of events and samples [ns]."""
        sampling = [self._every_ns] if self._is_sampled else []
        return [*sampling, *(max(time_ns, 1) for time_ns, _ in self._events)]

    def _sample(self) -> None:
        names = self._names()
        for measure, formula in self._sampled.values():
            if measure.over != "end":
                with suppress(NoMessageError):
                    self._add_sample(measure, self._expressions.evaluate(formula, names), formula)
        self._sampled_ns = self._simulation.time_ns
        for formula in self._plan.stop:
            with suppress(NoMessageError):
                self.is_over = self.is_over or bool(self._expressions.evaluate(formula, names))

    def _add_sample(self, measure: Measure, value: object, formula: Formula) -> None:
        values, name = self._values_so_far, measure.name
        if measure.over == "time":
            if value and name not in values:
                values[name] = self._simulation.time_ns / NS_PER_S
            return
        number = _number(value, formula)
        self._counts[name] = self._counts.get(name, 0) + 1
        match measure.over:
            case "min":
                values[name] = min(values.get(name, math.inf), number)
            case "max":
                values[name] = max(values.get(name, -math.inf), number)
            case "mean":
                values[name] = values.get(name, 0.0) + number
            case _:
                values.setdefault(name, number)

    def measures(self) -> dict[str, float | str | None]:
        """Return the value of each measure at the end; None without a message, or if a condition was never true.

        Raises:
            UsageError: an expression is not a finite number.
        """
        if self._is_sampled and self._sampled_ns != self._simulation.time_ns:
            self._sample()
        names = self._names()
        measured: dict[str, float | str | None] = {}
        for name, (measure, formula) in self._sampled.items():
            if measure.over == "end":
                try:
                    measured[name] = _number(self._expressions.evaluate(formula, names), formula)
                except NoMessageError:
                    measured[name] = None
            elif measure.over == "mean" and name in self._values_so_far:
                measured[name] = self._values_so_far[name] / self._counts[name]
            else:
                measured[name] = self._values_so_far.get(name)
        return measured


def _number(value: object, formula: Formula) -> float:
    if not isinstance(value, int | float) or not math.isfinite(value):
        raise UsageError(f"{formula.at}: error: {formula.text} must be a finite number, and is {value!r}")
    return float(value)
