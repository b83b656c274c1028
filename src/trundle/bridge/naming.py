"""How the simulation's names appear on the ROS graph.

SDF names may hold what ROS names may not (`::`, spaces, leading digits): `trundle.names.ros_name` maps them.
docs/decisions/0002 says why a single robot's links keep their plain names.
"""

from dataclasses import dataclass

from trundle.model import JointType, Model, World
from trundle.names import ros_name

WORLD_FRAME = "world"


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkFrame:
    """One link's place in the tf tree."""

    frame: str
    parent: str
    link: int
    """Index into `Snapshot.poses`."""
    parent_link: int | None
    """None: the parent is the world."""
    moves: bool
    """Whether the transform from the parent changes as time passes."""


def link_frame_name(model: Model, link: str, *, plain: bool) -> str:
    """A link's tf frame: its own name for a robot given alone, `<model>/<link>` in a world of several."""
    return ros_name(link) if plain else f"{ros_name(model.name)}/{ros_name(link)}"


def has_plain_frames(world: World) -> bool:
    """Whether one robot was given alone: all else was put around it by `run`."""
    return len([model for model in world.models if not model.added]) == 1 and any(m.added for m in world.models)


def link_frames(world: World) -> list[LinkFrame]:
    """Every link of the world as a frame, in the order of `Snapshot.poses`."""
    plain = has_plain_frames(world)
    frames: list[LinkFrame] = []
    for model in world.models:
        start = len(frames)
        index = {link.name: start + i for i, link in enumerate(model.links)}
        above = {joint.child: joint for joint in reversed(model.joints) if joint.parent in index}
        for link in model.links:
            joint = above.get(link.name)
            parent_link = None if joint is None else index[joint.parent]
            parent = WORLD_FRAME if joint is None else link_frame_name(model, joint.parent, plain=plain)
            rigid = joint is not None and (
                joint.type is JointType.FIXED or (joint.axis is not None and joint.axis.is_rigid)
            )
            frames.append(
                LinkFrame(
                    frame=link_frame_name(model, link.name, plain=plain),
                    parent=parent,
                    link=index[link.name],
                    parent_link=parent_link,
                    moves=not (rigid or model.static),
                )
            )
    return frames
