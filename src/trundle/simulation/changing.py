"""Worlds that change while they run: other names, and links that come free."""

from collections.abc import Iterable, Mapping
from dataclasses import replace

from trundle.model import Joint, World
from trundle.physics import Engine
from trundle.spatial import Pose, Twist


def renamed(world: World, name: str, new: str) -> World:
    """The world with a model of another name, and the joints between models that know it."""

    def linked(joint: Joint) -> Joint:
        parent, child = renamed_in((joint.parent, joint.child), {name: new})
        return replace(joint, parent=parent, child=child)

    return replace(
        world,
        models=tuple(replace(model, name=new) if model.name == name else model for model in world.models),
        joints=tuple(map(linked, world.joints)),
    )


def renamed_in(names: Iterable[str], models: Mapping[str, str]) -> list[str]:
    """`model::name` of each, with models called as they are now."""
    parts = [name.partition("::") for name in names]
    return [f"{models.get(model, model)}{colons}{rest}" for model, colons, rest in parts]


def keep_free(old: Engine, engine: Engine, links: Mapping[int, int]) -> None:
    """Have links that hung from something and are free now stay where they are, as fast as they were.

    Args:
        old: as it was.
        engine: as it is.
        links: where each link went.
    """
    poses, twists = old.reader.link_poses(), old.reader.link_twists()
    for before, link in links.items():
        if engine.is_free(link) and not old.is_free(before):
            x, y, z, qw, qx, qy, qz = poses[before].tolist()
            vx, vy, vz, wx, wy, wz = twists[before].tolist()
            engine.set_tree_pose(link, Pose((x, y, z), (qw, qx, qy, qz)))
            engine.set_tree_twist(link, Twist((vx, vy, vz), (wx, wy, wz)))
