"""Check that a GPU can step the worlds of all rows together."""

from collections.abc import Iterator

from msgspec.structs import replace

from trundle.base.diagnostics import DescriptionError, Source, TrundleError
from trundle.base.expressions import free_names
from trundle.sim.physics import gpu_differences, gpu_limits
from trundle.sim.simulation import Simulation
from trundle.studies.plan_files.variation import Value, Variation, quantile

from ..plan import Plan
from ..property_path import is_property
from ..row_runner import RowRunner
from ..rows import Row

_MAX_VALUES = 32
"""Maximum values of a list that are checked."""
_QUANTILES = (0.01, 0.99)
"""Quantiles of a distribution that are checked."""
_SHOWN = 3


def check_worlds(plan: Plan, first: Row, runner: RowRunner) -> None:
    """Refuse a world that a GPU cannot step, and quantities that change more than numbers of its compiled model.

    Raises:
        DescriptionError: such a world or quantity.
    """
    with runner.start(first) as run:
        simulation = run.simulation
        if simulation.actors:
            reason = f"a sweep on a GPU has no actors, as {next(iter(simulation.actors))!r}"
            raise DescriptionError(plan.world_at, f"{reason}; leave out the device")
        limits = gpu_limits(simulation.engine.compiled)
        if limits:
            reason = f"a GPU cannot step this world: {'; '.join(limits)}"
            raise DescriptionError(plan.world_at, f"{reason}; leave out the device")
        for variation in plan.vary:
            for value in _values(variation):
                other = replace(first, values={**first.values, variation.name: value})
                _check_compatible(plan, simulation, other, variation, runner)


def incompatibility(first: Simulation, other: Simulation) -> str:
    """Return why a GPU cannot step two worlds together; empty if it can."""
    differences = gpu_differences(first.engine.compiled, other.engine.compiled)
    more = f" and {len(differences) - _SHOWN} more" if len(differences) > _SHOWN else ""
    return f"the worlds differ in more than numbers: {', '.join(differences[:_SHOWN])}{more}" if differences else ""


def _values(variation: Variation) -> Iterator[Value]:
    if variation.distribution is not None:
        yield from (quantile(variation.distribution, q) for q in _QUANTILES)
    yield from variation.values[1 : 1 + _MAX_VALUES]


def _check_compatible(plan: Plan, first: Simulation, row: Row, variation: Variation, runner: RowRunner) -> None:
    try:
        with runner.start(row) as other:
            reason = incompatibility(first, other.simulation)
    except TrundleError:
        return  # the row reports it
    if reason:
        path, at = _assigned_at(plan, variation)
        message = f"{path}: a GPU steps worlds of one compiled model, and {reason}; leave it or the device out"
        raise DescriptionError(at, message)


def _assigned_at(plan: Plan, variation: Variation) -> tuple[str, Source]:
    """Return the path that a quantity changes, and its source."""
    if not is_property(variation.name):
        for path, formula in plan.assignments.items():
            if variation.name in free_names(formula.text):
                return path, formula.at
    return variation.name, variation.at
