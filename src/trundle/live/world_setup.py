"""Worlds to simulate, made from any description."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

from msgspec.structs import replace

from trundle.base.arguments import described
from trundle.base.diagnostics import Diagnostics, UsageError
from trundle.robots import model
from trundle.robots.description import LoadedDescription, load, load_text
from trundle.robots.model import flattened
from trundle.robots.packages import Packages
from trundle.sim.simulation import with_actors

if TYPE_CHECKING:  # SDF loads neither the URDF reader nor the builder
    from trundle.robots.description import Model, World
    from trundle.robots.robot import Robot


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadedWorld:
    """World ready to compile, and the URDF from which it was read, if any."""

    flat: model.World
    """World whose nested models are merged into the outer ones, as physics needs it."""
    nested: model.World
    """World with nested models, as in the file."""
    robot: "Robot | None"
    urdf: str | None
    """Expanded XML, for the parameter /robot_description."""


def load_world(
    file: str,
    packages: Packages,
    report: Diagnostics,
    *,
    seed: int = 0,
    arguments: Mapping[str, str] = MappingProxyType({}),
) -> LoadedWorld:
    """Read a file; add a ground plane and a sun if it is a robot or model.

    Args:
        file: see `trundle.robots.description.load`.
        packages: resolves URIs.
        report: collects all findings.
        seed: seed of random placement in SDF.
        arguments: arguments of a xacro file.

    Raises:
        DescriptionError: the file cannot be read.
    """
    return _with_ground_and_sun(load(file, report, packages=packages, seed=seed, arguments=arguments), packages, report)


def load_built(built: "Model | World", packages: Packages, report: Diagnostics, *, seed: int = 0) -> LoadedWorld:
    """Convert a model or world built in code, through its SDF; add a ground plane and a sun to a model.

    Raises:
        DescriptionError: its SDF is invalid.
    """
    text = built.to_sdf().encode()
    name = f"<{built.name}>"
    return _with_ground_and_sun(
        load_text(text, name=name, folder=Path.cwd(), packages=packages, report=report, seed=seed), packages, report
    )


def described_model(built: "Model | model.Model", packages: Packages, report: Diagnostics) -> model.Model:
    """Return the description of a model built in code, read from its SDF; a description is returned as it is.

    Raises:
        UsageError: the argument is neither.
        DescriptionError: the SDF is invalid.
    """
    if isinstance(built, model.Model):
        return built
    if not hasattr(built, "add_joint"):  # a description needs no import of the builder
        raise UsageError(f"a model is needed, as trundle.Model or ModelHandle.model, got {described(built)}")
    text, folder = built.to_sdf().encode(), Path.cwd()
    loaded = load_text(text, name=f"<{built.name}>", folder=folder, packages=packages, report=report)
    return flattened(loaded.world).models[0]


def _with_ground_and_sun(loaded: LoadedDescription, packages: Packages, report: Diagnostics) -> LoadedWorld:
    """Add a ground plane and a sun, unless the description is a world."""
    world = loaded.world if loaded.kind == "world" else _add_ground_and_sun(loaded, packages, report)
    return LoadedWorld(flat=with_actors(flattened(world), report), nested=world, robot=loaded.robot, urdf=loaded.urdf)


def _add_ground_and_sun(loaded: LoadedDescription, packages: Packages, report: Diagnostics) -> model.World:
    ground = load("model://ground_plane", report, packages=packages).world.models
    sun = load("model://sun", report, packages=packages).world.lights
    world = loaded.world
    return replace(
        world,
        models=(
            *world.models,
            *(replace(m, added=True) for m in ground if m.name not in {t.name for t in world.models}),
        ),
        lights=(*world.lights, *(replace(light, added=True) for light in sun)),
    )
