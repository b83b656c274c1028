"""What compiled plugins ask for between two steps."""

import math
import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TypeAlias

from msgspec.structs import replace

from trundle.base.diagnostics import UsageError
from trundle.robots.description import LoadedDescription, load, load_text
from trundle.robots.model import Collision, Joint, JointAxis, JointType, Link, Model
from trundle.robots.packages import Packages
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose

from .visuals import change_visual, draw_line

_Request: TypeAlias = Callable[[Simulation, Sequence[str], Sequence[float]], None]
_FREE = 1e15
"""Limit from which on a joint is unlimited [rad or m]."""


def perform(sim: Simulation, words: Sequence[str], numbers: Sequence[float]) -> None:
    """Do what a plugin asked for.

    Args:
        sim: the simulation, between two steps.
        words: name of the request, and its texts.
        numbers: its numbers.

    Raises:
        TrundleError: it cannot be done.
    """
    _REQUESTS[words[0]](sim, words[1:], numbers)


def _set_model_pose(sim: Simulation, words: Sequence[str], numbers: Sequence[float]) -> None:
    x, y, z, *rotation = numbers
    qw, qx, qy, qz = rotation
    sim[words[0]].set_pose(Pose((x, y, z), (qw, qx, qy, qz)))


def _attach(sim: Simulation, words: Sequence[str], numbers: Sequence[float]) -> None:
    name, kind, parent, child = words
    try:
        joint_type = JointType(kind)
    except ValueError:
        raise UsageError(f"joint {name!r}: no type {kind!r}") from None
    axis = None
    pose = Pose()
    if numbers:
        x, y, z, lower, upper, px, py, pz = numbers
        pose = Pose((px, py, pz))
        if joint_type is not JointType.FIXED:
            is_limited = upper - lower < _FREE
            lower, upper = (lower, upper) if is_limited else (-math.inf, math.inf)
            axis = JointAxis(direction=(x, y, z), lower=lower, upper=upper)
    if any(joint.name == name for joint in sim.world.joints):
        sim.detach(name)
    at = sim.world.at
    sim.attach(Joint(name=name, at=at, type=joint_type, parent=parent, child=child, child_from_joint=pose, axis=axis))


def _detach(sim: Simulation, words: Sequence[str], numbers: Sequence[float]) -> None:
    del numbers
    if any(joint.name == words[0] for joint in sim.world.joints):
        sim.detach(words[0])


def _set_gravity(sim: Simulation, words: Sequence[str], numbers: Sequence[float]) -> None:
    del words
    x, y, z = numbers
    sim.edit(replace(sim.world, physics=replace(sim.world.physics, gravity=(x, y, z))))


def _set_surfaces(sim: Simulation, words: Sequence[str], numbers: Sequence[float]) -> None:
    """Change contact parameters of collisions `model::link::collision`: six numbers for each.

    They are two coefficients of friction, the first direction, and whether contacts have no force.
    """
    if not all(map(math.isfinite, numbers)):
        raise UsageError(f"the surface of {', '.join(words)}: {[*numbers]}; these are finite numbers")
    changes: dict[tuple[str, str, str], tuple[float, ...]] = {}
    for index, name in enumerate(words):
        _, link_name, collision_name = name.rsplit("::", 2)
        changes[name.split("::", 1)[0], link_name, collision_name] = tuple(numbers[6 * index : 6 * index + 6])

    def changed(model: Model, link: Link, collision: Collision) -> Collision:
        values = changes.get((model.name, link.name.rpartition("::")[2], collision.name))
        if values is None:
            return collision
        mu, mu2, x, y, z, is_ghost = values
        surface = replace(collision.surface, mu=mu, mu2=mu2, fdir1=(x, y, z), collide_without_contact=bool(is_ghost))
        return replace(collision, surface=surface)

    def with_surfaces(model: Model, link: Link) -> Link:
        return replace(link, collisions=tuple(changed(model, link, collision) for collision in link.collisions))

    models = tuple(
        replace(model, links=tuple(with_surfaces(model, link) for link in model.links))
        if any(name == model.name for name, _, _ in changes)
        else model
        for model in sim.world.models
    )
    sim.edit(replace(sim.world, models=models))


def _insert(sim: Simulation, words: Sequence[str], numbers: Sequence[float]) -> None:
    """Add the models of a text, at a pose if there is one."""
    folder = Path(sim.world.at.file).parent
    text = load_text(words[0], name="<plugin>", folder=folder, packages=_packages(sim), report=sim.report)
    _spawn(sim, text, numbers)


def _insert_file(sim: Simulation, words: Sequence[str], numbers: Sequence[float]) -> None:
    """Add the models of a file or of model://NAME."""
    _spawn(sim, load(words[0], sim.report, packages=_packages(sim)), numbers)


def _packages(sim: Simulation) -> Packages:
    return Packages(os.environ, start=Path(sim.world.at.file))


def _spawn(sim: Simulation, loaded: LoadedDescription, numbers: Sequence[float]) -> None:
    for model in loaded.world.models:
        _spawn_model(sim, model, numbers)


def _spawn_model(sim: Simulation, model: Model, numbers: Sequence[float], *, allow_renaming: bool = False) -> None:
    if numbers:
        x, y, z, *rotation = numbers
        qw, qx, qy, qz = rotation
        model = replace(model, world_from_model=Pose((x, y, z), (qw, qx, qy, qz)))
    sim.spawn(model, allow_renaming=allow_renaming)


def _clone(sim: Simulation, words: Sequence[str], numbers: Sequence[float]) -> None:
    model = sim[words[0]].model
    _spawn_model(sim, replace(model, name=f"{model.name}_clone"), numbers, allow_renaming=True)


def _set_step_size(sim: Simulation, words: Sequence[str], numbers: Sequence[float]) -> None:
    del words
    (step_s,) = numbers
    if not 0.0 < step_s < math.inf:
        raise UsageError(f"a step of {step_s} s; it is above 0")
    sim.edit(replace(sim.world, physics=replace(sim.world.physics, max_step_size_s=step_s)))


_REQUESTS: Mapping[str, _Request] = {
    "set_model_pose": _set_model_pose,
    "line": draw_line,
    "visual": change_visual,
    "attach": _attach,
    "detach": _detach,
    "gravity": _set_gravity,
    "surfaces": _set_surfaces,
    "step_size": _set_step_size,
    "insert": _insert,
    "insert_file": _insert_file,
    "clone": _clone,
    "reset": lambda sim, _words, _numbers: sim.reset(),
    "reset_time": lambda sim, _words, _numbers: sim.reset(poses=False),
    "reset_poses": lambda sim, _words, _numbers: sim.reset(time=False),
    "reset_model": lambda sim, words, _numbers: sim[words[0]].reset(),
    "delete": lambda sim, words, _numbers: sim.delete(words[0]),
}
