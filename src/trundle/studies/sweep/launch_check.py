"""Check of a plan's assignments against the names in a launch."""

from collections.abc import Iterator
from itertools import pairwise

from trundle.base.diagnostics import DescriptionError, Diagnostics, UsageError, nearest
from trundle.live.launch.loaded_launch import LoadedLaunch
from trundle.robots.model import World
from trundle.robots.names import is_legal_name

from .assignments import Assignments, Property
from .launch_inputs import launch_inputs, words_of
from .property_path import PARAMETERS

_MODELS = "models"


def check_launch(launch: LoadedLaunch, assigned: Assignments) -> list[str]:
    """Refuse invalid assignments; return warnings of names that only the launch's programs may define.

    Args:
        launch: launch with its own parameters.
        assigned: values of a row.

    Raises:
        TrundleError: illegal parameter name, or unknown property of a world or model of the launch.
    """
    report = Diagnostics()
    _check_parameters(launch, assigned, report)
    worlds = launch_inputs(launch).worlds
    names = {model.name for world in worlds for model in world.models} | set(_spawned_names(launch))
    for property_ in assigned.properties:
        kind, _, rest = property_.path.partition("/")
        name = rest.partition("/")[0] if kind == _MODELS else None
        if name is None or name in names:
            _check_property(property_, [world for world in worlds if name is None or _has(world, name)])
        elif name != "*":
            closest = nearest(name, names)
            hint = f"; the nearest is {closest!r}" if closest else ""
            listed = ", ".join(map(repr, sorted(names))) or "none"
            message = (
                f"{property_.path}: the launch names no model {name!r}{hint}; models: {listed}; a program must spawn it"
            )
            report.warn(property_.at, message)
    return report.warnings


def _check_parameters(launch: LoadedLaunch, assigned: Assignments, report: Diagnostics) -> None:
    names = {param.name for param in launch.params}
    for name in assigned.parameters:
        path = f"{PARAMETERS}{name}"
        at = assigned.sources[path]
        if not is_legal_name(name):
            raise DescriptionError(at, f"{path}: not a legal name of a ROS parameter")
        if name not in names and not any(other.startswith(f"{name}/") for other in names):
            closest = nearest(name, names)
            hint = f"; the nearest is {closest!r}" if closest else ""
            report.warn(at, f"{path}: the launch sets no parameter {name!r}{hint}; each run sets it nevertheless")


def _spawned_names(launch: LoadedLaunch) -> Iterator[str]:
    """Yield the names of the models that nodes spawn."""
    for node in launch.plan.nodes:
        for option, word in pairwise(words_of(node)):
            if option == "-model":
                yield word


def _has(world: World, model: str) -> bool:
    return any(candidate.name == model for candidate in world.models)


def _check_property(property_: Property, worlds: list[World]) -> None:
    """Refuse a property that no world has."""
    errors: list[UsageError] = []
    for world in worlds:
        try:
            property_.assigned(world)
        except UsageError as error:
            errors.append(error)
    if worlds and len(errors) == len(worlds):
        raise errors[0]
