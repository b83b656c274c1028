"""World of a dataset: the plan's world with its objects and distractors."""

import os
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path

from msgspec.structs import replace

from trundle.base.diagnostics import DescriptionError, Diagnostics, Source, UsageError
from trundle.live.world_setup import load_world
from trundle.robots.description import load
from trundle.robots.model import Model, flattened
from trundle.robots.packages import Packages
from trundle.sim.simulation import Simulation
from trundle.studies.datasets import DatasetPlan, DistractorPlan, Instance, ObjectPlan, PictureMaker, distractor_models


def picture_maker(plan: DatasetPlan) -> PictureMaker:
    """Read a plan's world and models, and return the maker of its pictures.

    Raises:
        DescriptionError: the plan, or a file that it names, is invalid.
    """
    packages = Packages(dict(os.environ), start=Path.cwd())
    with _errors_at(plan.world_at):
        world = load_world(plan.world, packages, Diagnostics(), seed=plan.seed).flat
    names = {model.name for model in world.models}
    instances: list[Instance] = []
    added: list[Model] = []
    for item in plan.objects:
        if item.model is None:
            _check_name(item, names)
            instances.append(_object(len(instances) + 1, item.name, item))
            continue
        model = _read_model(item, item.model, packages)
        for count in range(round(item.count.largest)):
            added.append(replace(model, name=_unique_name(f"{item.name}_{count}", names), static=False))
            instances.append(_object(len(instances) + 1, added[-1].name, item))
    if plan.distractors is not None:
        for model in distractor_models(plan.distractors, plan.seed):
            added.append(replace(model, name=_unique_name(model.name, names)))
            instances.append(_distractor(len(instances) + 1, added[-1].name, plan.distractors))
    moved = {
        item.model for item in instances if item.placement.surface is not None or item.placement.position is not None
    }
    models = tuple(replace(model, static=False) if model.name in moved else model for model in world.models)
    simulation = Simulation(replace(world, models=(*models, *added)), Diagnostics(), seed=plan.seed)
    return PictureMaker(plan, simulation, instances)


@contextmanager
def _errors_at(at: Source) -> Generator[None]:
    """Report a missing file at its source in the plan."""
    try:
        yield
    except DescriptionError as error:
        if error.at.line is not None:
            raise
        raise DescriptionError(at, f"{error.at}: {error.what}") from None
    except UsageError as error:
        raise DescriptionError(at, str(error)) from None


def _check_name(plan: ObjectPlan, names: set[str]) -> None:
    if plan.name not in names:
        listed = ", ".join(sorted(names)) or "none"
        message = f"the world has no model {plan.name!r}; models: {listed}; `model: FILE` adds one"
        raise DescriptionError(plan.at, message)


def _object(number: int, model: str, plan: ObjectPlan) -> Instance:
    return Instance(number=number, model=model, placement=plan.placement, paint=plan.paint, plan=plan)


def _distractor(number: int, model: str, plan: DistractorPlan) -> Instance:
    return Instance(number=number, model=model, placement=plan.placement, paint=plan.paint, plan=None)


def _unique_name(name: str, names: set[str]) -> str:
    """Return a unique name, and add it to the names in use."""
    while name in names:
        name += "_"
    names.add(name)
    return name


def _read_model(plan: ObjectPlan, file: str, packages: Packages) -> Model:
    """Read a model.

    Raises:
        DescriptionError: the file cannot be read, or is a world.
    """
    with _errors_at(plan.at):
        loaded = load(file, Diagnostics(), packages=packages)
    if loaded.kind == "world":
        raise DescriptionError(plan.at, f"{file} is a world; an object's `model` is a model, SDF or URDF")
    return flattened(loaded.world).models[0]
