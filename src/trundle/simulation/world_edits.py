"""Worlds that change while they run: what may come and go, and how the engine goes on with what there is then."""

from collections.abc import Iterable, Mapping
from itertools import count

from msgspec.structs import replace

from trundle.diagnostics import Diagnostics, UsageError
from trundle.model import Joint, World
from trundle.physics import Engine, compile_world
from trundle.spatial import Pose, Twist, pose_from_row


def unique_name(world: World, name: str) -> str:
    """The name, or where there is a model of that name with _0 added, else _1, …, as Gazebo does."""
    taken = {model.name for model in world.models}
    numbered = (f"{name}_{number}" for number in count())
    return name if name not in taken else next(each for each in numbered if each not in taken)


def check_name_is_free(world: World, name: str) -> None:
    """Make sure that a model can be called so.

    Raises:
        UsageError: one is, or it is no name.
    """
    if not name or any(there.name == name for there in world.models):
        raise UsageError(f"there is a model {name!r} already" if name else "a model needs a name")


def check_same_structure(world: World, edited: World) -> None:
    """Make sure that a world can go on as an edited one.

    Raises:
        UsageError: what there is, is different.
    """
    if _structure(edited) != _structure(world):
        raise UsageError("an edited world has other models, links or joints; spawn and delete change those")


def _structure(world: World) -> list[tuple[str, list[str], list[str]]]:
    return [(m.name, [link.name for link in m.links], [joint.name for joint in m.joints]) for m in world.models]


def without_model(world: World, name: str) -> World:
    """The world without a model, and without the joints that joined it with others."""

    def joins(joint: Joint) -> bool:
        return any(link.startswith(f"{name}::") for link in (joint.parent, joint.child))

    return replace(
        world,
        models=tuple(model for model in world.models if model.name != name),
        joints=tuple(joint for joint in world.joints if not joins(joint)),
    )


def without_joint(world: World, name: str) -> World:
    """The world without a joint between models.

    Raises:
        UsageError: with the names there are.
    """
    names = [joint.name for joint in world.joints]
    if name not in names:
        there = ", ".join(map(repr, names)) or "none"
        raise UsageError(f"no joint {name!r} between models; there are: {there}")
    return replace(world, joints=tuple(joint for joint in world.joints if joint.name != name))


def with_model_renamed(world: World, name: str, new: str) -> World:
    """The world with a model of another name, and the joints between models that know it."""

    def linked(joint: Joint) -> Joint:
        parent, child = current_names((joint.parent, joint.child), {name: new})
        return replace(joint, parent=parent, child=child)

    return replace(
        world,
        models=tuple(replace(model, name=new) if model.name == name else model for model in world.models),
        joints=tuple(map(linked, world.joints)),
    )


def with_model_at(world: World, name: str, world_from_model: Pose) -> World:
    """The world with a model elsewhere."""
    return replace(
        world,
        models=tuple(
            replace(model, world_from_model=world_from_model) if model.name == name else model for model in world.models
        ),
    )


def current_names(names: Iterable[str], models: Mapping[str, str]) -> list[str]:
    """`model::name` of each, with models called as they are now."""
    parts = [name.partition("::") for name in names]
    return [f"{models.get(model, model)}{colons}{rest}" for model, colons, rest in parts]


def transferred_engine(
    old: Engine, world: World, report: Diagnostics, models: Mapping[str, str]
) -> tuple[Engine, dict[int, int]]:
    """An engine of a changed world in the state of the old one, and where each link went that is still there.

    Args:
        old: as it was.
        world: the changed one.
        report: takes what physics has to mend.
        models: those that have another name now, by the one they had.

    Raises:
        DescriptionError: the engine cannot simulate it.
    """
    engine = Engine(compile_world(world, report))
    engine.transfer_from(old, renamed=models)
    there = {name: i for i, name in enumerate(engine.compiled.link_names)}
    before = enumerate(current_names(old.compiled.link_names, models))
    links = {i: there[name] for i, name in before if name in there}
    _keep_free_links(old, engine, links)
    return engine, links


def _keep_free_links(old: Engine, engine: Engine, links: Mapping[int, int]) -> None:
    """Have links that hung from something and are free now stay where they are, as fast as they were.

    Args:
        old: as it was.
        engine: as it is.
        links: where each link went.
    """
    poses, twists = old.reader.link_poses(), old.reader.link_twists()
    for before, link in links.items():
        if engine.writer.is_free(link) and not old.writer.is_free(before):
            vx, vy, vz, wx, wy, wz = twists[before].tolist()
            engine.writer.set_tree_pose(link, pose_from_row(poses[before]))
            engine.writer.set_tree_twist(link, Twist((vx, vy, vz), (wx, wy, wz)))
