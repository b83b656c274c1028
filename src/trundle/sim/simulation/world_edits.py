"""Edits of running worlds: spawn, delete, rename, and the transfer to a new engine."""

import re
from collections.abc import Iterable, Mapping
from itertools import count
from typing import TYPE_CHECKING

from msgspec.structs import replace

from trundle.base.diagnostics import Diagnostics, UsageError, no_such
from trundle.robots.model import Joint, World
from trundle.sim.physics import Engine, compile_world
from trundle.spatial import Pose, Twist, pose_from_row

if TYPE_CHECKING:
    from trundle.sim.physics import BackgroundCutting

WORLD = "world"
"""Name that stands for the world as the parent of a joint."""
_CONTROL = re.compile(r"[\x00-\x1f\x7f]")


def unique_name(world: World, name: str) -> str:
    """Return the name, with _0, _1, … appended if it is taken, as Gazebo does."""
    taken = {model.name for model in world.models}
    numbered = (f"{name}_{number}" for number in count())
    return name if name not in taken else next(candidate for candidate in numbered if candidate not in taken)


def check_name_is_free(world: World, name: str) -> None:
    """Check that a model name is free.

    Raises:
        UsageError: the name is taken, empty, or has a control character.
    """
    if _CONTROL.search(name):
        raise UsageError(f"a model cannot be named {name!r}: it holds a control character")
    if not name or any(model.name == name for model in world.models):
        raise UsageError(f"there is a model {name!r} already" if name else "a model needs a name")


def check_same_structure(world: World, edited: World) -> None:
    """Check that an edited world has the same models, links and joints.

    Raises:
        UsageError: the edited world has others.
    """
    if _structure(edited) != _structure(world):
        raise UsageError("an edited world has other models, links or joints; use spawn and delete to change those")


def _structure(world: World) -> list[tuple[str, list[str], list[str]]]:
    return [(m.name, [link.name for link in m.links], [joint.name for joint in m.joints]) for m in world.models]


def without_model(world: World, name: str) -> World:
    """Return the world without a model and its joints with others."""

    def joins(joint: Joint) -> bool:
        return any(link.startswith(f"{name}::") for link in (joint.parent, joint.child))

    return replace(
        world,
        models=tuple(model for model in world.models if model.name != name),
        joints=tuple(joint for joint in world.joints if not joins(joint)),
    )


def without_joint(world: World, name: str) -> World:
    """Return the world without a joint between models.

    Raises:
        UsageError: no such joint; the message lists the joints.
    """
    names = [joint.name for joint in world.joints]
    if name not in names:
        raise UsageError(no_such("no joint between models", name, names))
    return replace(world, joints=tuple(joint for joint in world.joints if joint.name != name))


def with_model_renamed(world: World, name: str, new: str) -> World:
    """Return the world with a model renamed, also in the joints between models."""

    def renamed(joint: Joint) -> Joint:
        parent, child = current_names((joint.parent, joint.child), {name: new})
        return replace(joint, parent=parent, child=child)

    return replace(
        world,
        models=tuple(replace(model, name=new) if model.name == name else model for model in world.models),
        joints=tuple(map(renamed, world.joints)),
    )


def with_model_at(world: World, name: str, world_from_model: Pose) -> World:
    """Return the world with a model at another pose, moved with the fixed joints that attach it to the world."""
    before = next(model.world_from_model for model in world.models if model.name == name)
    moved = world_from_model @ before.inverse()

    def moved_joint(joint: Joint) -> Joint:
        if joint.parent_from_child is None or joint.parent != WORLD or not joint.child.startswith(f"{name}::"):
            return joint
        return replace(joint, parent_from_child=moved @ joint.parent_from_child)

    return replace(
        world,
        models=tuple(
            replace(model, world_from_model=world_from_model) if model.name == name else model for model in world.models
        ),
        joints=tuple(map(moved_joint, world.joints)),
    )


def current_names(names: Iterable[str], models: Mapping[str, str]) -> list[str]:
    """Return each `model::name` with the current name of the model."""
    parts = [name.partition("::") for name in names]
    return [f"{models.get(model, model)}{colons}{rest}" for model, colons, rest in parts]


def transferred_engine(
    old: Engine,
    world: World,
    report: Diagnostics,
    models: Mapping[str, str],
    cutting: "BackgroundCutting | None",
) -> tuple[Engine, dict[int, int]]:
    """Return an engine of a changed world in the old one's state, and the new index of each link that still exists.

    Args:
        old: previous engine.
        world: changed world.
        report: receives the warnings of the compile.
        models: renamed models, old name → new name.
        cutting: see `compile_world`.

    Raises:
        DescriptionError: MuJoCo cannot simulate it.
    """
    engine = Engine(compile_world(world, report, cutting=cutting))
    engine.transfer_from(old, renamed=models)
    index = {name: i for i, name in enumerate(engine.compiled.link_names)}
    old_names = enumerate(current_names(old.compiled.link_names, models))
    links = {i: index[name] for i, name in old_names if name in index}
    _keep_free_links(old, engine, links)
    return engine, links


def _keep_free_links(old: Engine, engine: Engine, links: Mapping[int, int]) -> None:
    """Keep pose and twist of links that have become free.

    Args:
        old: previous engine.
        engine: new engine.
        links: old → new index.
    """
    poses, twists = old.reader.link_poses(), old.reader.link_twists()
    for before, link in links.items():
        if engine.writer.is_free(link) and not old.writer.is_free(before):
            vx, vy, vz, wx, wy, wz = twists[before].tolist()
            engine.writer.set_tree_pose(link, pose_from_row(poses[before]))
            engine.writer.set_tree_twist(link, Twist((vx, vy, vz), (wx, wy, wz)))
