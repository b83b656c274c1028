"""World of a dataset: the plan's, with its objects and distractors in it."""

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
    """Read a plan's world and models, and prepare its pictures.

    Raises:
        DescriptionError: with the line of the plan or of the file.
    """
    packages = Packages(dict(os.environ), start=Path.cwd())
    with _errors_at(plan.world_at):
        world = load_world(plan.world, packages, Diagnostics(), seed=plan.seed).flat
    names = {model.name for model in world.models}
    instances: list[Instance] = []
    added: list[Model] = []
    for each in plan.objects:
        if each.model is None:
            _check_name(each, names)
            instances.append(_object(len(instances) + 1, each.name, each))
            continue
        model = _read_model(each, each.model, packages)
        for count in range(round(each.count.largest)):
            added.append(replace(model, name=_free(f"{each.name}_{count}", names), static=False))
            instances.append(_object(len(instances) + 1, added[-1].name, each))
    if plan.distractors is not None:
        for model in distractor_models(plan.distractors, plan.seed):
            added.append(replace(model, name=_free(model.name, names)))
            instances.append(_distractor(len(instances) + 1, added[-1].name, plan.distractors))
    moved = {
        each.model for each in instances if each.placement.surface is not None or each.placement.position is not None
    }
    models = tuple(replace(model, static=False) if model.name in moved else model for model in world.models)
    simulation = Simulation(replace(world, models=(*models, *added)), Diagnostics(), seed=plan.seed)
    return PictureMaker(plan, simulation, instances)


@contextmanager
def _errors_at(at: Source) -> Generator[None]:
    """Say where in the plan a file is named that is not found."""
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
        there = ", ".join(sorted(names)) or "none"
        what = f"the world has no model {plan.name!r}; models: {there}; `model: FILE` adds one"
        raise DescriptionError(plan.at, what)


def _object(number: int, model: str, plan: ObjectPlan) -> Instance:
    return Instance(number=number, model=model, placement=plan.placement, paint=plan.paint, plan=plan)


def _distractor(number: int, model: str, plan: DistractorPlan) -> Instance:
    return Instance(number=number, model=model, placement=plan.placement, paint=plan.paint, plan=None)


def _free(name: str, names: set[str]) -> str:
    """Return a name that no model has yet, and take it."""
    while name in names:
        name += "_"
    names.add(name)
    return name


def _read_model(plan: ObjectPlan, file: str, packages: Packages) -> Model:
    """Read a model.

    Raises:
        DescriptionError: it cannot be read, or is a world.
    """
    with _errors_at(plan.at):
        loaded = load(file, Diagnostics(), packages=packages)
    if loaded.kind == "world":
        raise DescriptionError(plan.at, f"{file} is a world; an object's `model` is a model, SDF or URDF")
    return flattened(loaded.world).models[0]
