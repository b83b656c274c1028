"""Values assigned by a row: arguments, ROS parameters and properties of the world."""

from collections.abc import Generator
from contextlib import contextmanager
from typing import TypeVar

from msgspec import Struct

from trundle.base.diagnostics import DescriptionError, Source, UnknownArgumentError, UsageError
from trundle.studies.plan_files.variation import Value

from .plan import Formula, Plan
from .property_path import ARGUMENTS, PARAMETERS, is_property, with_property
from .rows import Row
from .state_names import StateExpressions, named_values

_T = TypeVar("_T")


class Property(Struct, frozen=True):
    """Assigned property of the world."""

    path: str
    value: Value
    at: Source

    def assigned(self, world: _T) -> _T:
        """Return the world with this property.

        Raises:
            UsageError: no such property, with the plan's line.
        """
        try:
            return with_property(world, self.path, self.value)
        except UsageError as error:
            raise UsageError(f"{self.at}: error: {error}") from None


class Assignments(Struct, frozen=True):
    """Values of one row."""

    arguments: dict[str, str]
    """Arguments of the xacro or launch file."""
    parameters: dict[str, Value]
    """Global name of a ROS parameter → its value."""
    properties: list[Property]
    sources: dict[str, Source]
    """Path → source of the assignment."""

    @contextmanager
    def unknown_arguments_at_plan(self) -> Generator[None]:
        """Report an unknown argument at its assignment in the plan."""
        try:
            yield
        except UnknownArgumentError as error:
            path = f"{ARGUMENTS}/{error.name}"
            raise DescriptionError(self.sources[path], f"{path}: {error.at}: {error.what}") from None


def assignments_of(plan: Plan, row: Row, expressions: StateExpressions) -> Assignments:
    """Return the assignments of a row.

    Raises:
        UsageError: an expression of `set` has an invalid value, with its line.
    """
    assigned = {
        item.name: Property(item.name, row.values[item.name], item.at) for item in plan.vary if is_property(item.name)
    }
    names = named_values(row.values)
    for path, formula in plan.assignments.items():
        assigned[path] = Property(path, _plain(expressions.evaluate(formula, names), formula), formula.at)
    assignments = Assignments({}, {}, [], {path: item.at for path, item in assigned.items()})
    for path, item in assigned.items():
        kind, _, name = path.partition("/")
        if kind == ARGUMENTS:
            assignments.arguments[name] = _text(item.value)
        elif kind == PARAMETERS:
            assignments.parameters[f"/{name}"] = item.value
        else:
            assignments.properties.append(item)
    return assignments


def _plain(value: object, formula: Formula) -> Value:
    if isinstance(value, list | tuple):
        return tuple(_plain(part, formula) for part in value)
    if not isinstance(value, bool | int | float | str):
        raise UsageError(f"{formula.at}: error: {formula.text} must be a number, a text or a list, and is {value!r}")
    return value


def _text(value: Value) -> str:
    """Return a value as an argument of xacro or roslaunch."""
    return str(value).lower() if isinstance(value, bool) else str(value)
