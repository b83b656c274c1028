"""How the simulation's names appear on the ROS graph.

SDF names may hold what ROS names may not (`::`, spaces, leading digits): `trundle.names.ros_name` maps them.
docs/decisions/0002 says why a single robot's links keep their plain names.
"""

from dataclasses import dataclass

from trundle.model import JointType, Model, Sensor, World
from trundle.names import ros_name

WORLD_FRAME = "world"
_NO_TOPIC = ("__default__", "__default_topic__")
"""What old files write where they mean none."""


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


def sensor_topic(model: Model, place: str, sensor: Sensor, output: str, *, main: str, part: str = "") -> str:
    """The topic of one of a sensor's outputs: `/<model>/<place>/<sensor>/<output>`, unless the file has a <topic>.

    A <topic> is where the main output goes; camera_info goes beside it, as in gz, and everything else below it.

    Args:
        model: whose it is.
        place: the link or joint that it is on.
        sensor: with its name, and its topic if it has one.
        output: what is published: imu, scan, image_raw, …
        main: the output that the sensor is for.
        part: which of a multicamera's cameras.
    """
    parts = (part,) if part else ()
    given = sensor.topic.strip().removeprefix("~").strip("/")
    if not given or given in _NO_TOPIC:
        return "/" + "/".join(ros_name(name) for name in (model.name, place, sensor.name, *parts, output))
    topic = "/" + "/".join(ros_name(name) for name in (given, *parts))
    if output == main and not part:
        return topic
    if output == "camera_info" and not part:
        return f"{topic.rpartition('/')[0]}/camera_info"
    return f"{topic}/{output}"


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
