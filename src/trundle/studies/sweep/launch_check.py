"""Names that a plan assigns, against those that a launch has."""

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


def check_launch(read: LoadedLaunch, assigned: Assignments) -> list[str]:
    """Refuse what a launch cannot have; return warnings of what only its programs could use or make.

    Args:
        read: the launch, with its own parameters.
        assigned: values of a row.

    Raises:
        TrundleError: a parameter's name is not legal, or a world or model of the launch has no such property.
    """
    report = Diagnostics()
    _check_parameters(read, assigned, report)
    worlds = launch_inputs(read).worlds
    names = {model.name for world in worlds for model in world.models} | set(_spawned_names(read))
    for each in assigned.properties:
        kind, _, rest = each.path.partition("/")
        name = rest.partition("/")[0] if kind == _MODELS else None
        if name is None or name in names:
            _check_property(each, [world for world in worlds if name is None or _has(world, name)])
        elif name != "*":
            near = nearest(name, names)
            said = f"; the nearest is {near!r}" if near else ""
            there = ", ".join(map(repr, sorted(names))) or "none"
            what = f"{each.path}: the launch names no model {name!r}{said}; models: {there}; a program must spawn it"
            report.warn(each.at, what)
    return report.warnings


def _check_parameters(read: LoadedLaunch, assigned: Assignments, report: Diagnostics) -> None:
    there = {param.name for param in read.params}
    for name in assigned.parameters:
        path = f"{PARAMETERS}{name}"
        at = assigned.sources[path]
        if not is_legal_name(name):
            raise DescriptionError(at, f"{path}: not a legal name of a ROS parameter")
        if name not in there and not any(each.startswith(f"{name}/") for each in there):
            near = nearest(name, there)
            said = f"; the nearest is {near!r}" if near else ""
            report.warn(at, f"{path}: the launch sets no parameter {name!r}{said}; each run has it all the same")


def _spawned_names(read: LoadedLaunch) -> Iterator[str]:
    """Yield the names that nodes give to the models that they spawn."""
    for node in read.plan.nodes:
        for option, word in pairwise(words_of(node)):
            if option == "-model":
                yield word


def _has(world: World, model: str) -> bool:
    return any(each.name == model for each in world.models)


def _check_property(each: Property, worlds: list[World]) -> None:
    """Refuse a property that none of some worlds has."""
    errors: list[UsageError] = []
    for world in worlds:
        try:
            each.assigned(world)
        except UsageError as error:
            errors.append(error)
    if worlds and len(errors) == len(worlds):
        raise errors[0]
