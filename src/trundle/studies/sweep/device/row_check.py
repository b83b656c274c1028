"""Rows whose worlds a GPU cannot step beside the first row's."""

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

_MOST = 32
"""Most values of a list that are tried."""
_QUANTILES = (0.01, 0.99)
"""Quantiles of a distribution that are tried."""
_SHOWN = 3


def check_worlds(plan: Plan, first: Row, runner: RowRunner) -> None:
    """Refuse a world that a GPU cannot step, and quantities that change more than the numbers of its model.

    Raises:
        DescriptionError: which; with its line.
    """
    with runner.start(first) as run:
        simulation = run.simulation
        if simulation.actors:
            what = f"a sweep on a GPU has no actors, as {next(iter(simulation.actors))!r}"
            raise DescriptionError(plan.world_at, f"{what}; leave out the device")
        limits = gpu_limits(simulation.engine.compiled)
        if limits:
            what = f"a GPU cannot step this world: {'; '.join(limits)}"
            raise DescriptionError(plan.world_at, f"{what}; leave out the device")
        for variation in plan.vary:
            for value in _values(variation):
                other = replace(first, values={**first.values, variation.name: value})
                _check_beside(plan, simulation, other, variation, runner)


def why_not_beside(first: Simulation, other: Simulation) -> str:
    """Return why a GPU cannot step two worlds side by side; empty: it can."""
    found = gpu_differences(first.engine.compiled, other.engine.compiled)
    more = f" and {len(found) - _SHOWN} more" if len(found) > _SHOWN else ""
    return f"the worlds differ in more than numbers: {', '.join(found[:_SHOWN])}{more}" if found else ""


def _values(variation: Variation) -> Iterator[Value]:
    if variation.distribution is not None:
        yield from (quantile(variation.distribution, q) for q in _QUANTILES)
    yield from variation.values[1 : 1 + _MOST]


def _check_beside(plan: Plan, first: Simulation, row: Row, variation: Variation, runner: RowRunner) -> None:
    try:
        with runner.start(row) as other:
            why = why_not_beside(first, other.simulation)
    except TrundleError:
        return  # the row says so
    if why:
        path, at = _assigned_at(plan, variation)
        what = f"{path}: a GPU steps worlds of one compiled model, and {why}; leave it or the device out"
        raise DescriptionError(at, what)


def _assigned_at(plan: Plan, variation: Variation) -> tuple[str, Source]:
    """Return the path that a quantity changes, and its line."""
    if not is_property(variation.name):
        for path, formula in plan.assignments.items():
            if variation.name in free_names(formula.text):
                return path, formula.at
    return variation.name, variation.at
