"""tf frames and topics of a simulation's links and sensors.

SDF names may have characters that ROS names may not (`::`, spaces, leading digits): `trundle.robots.names.ros_name`
maps them. docs/decisions/0002: why a single robot's links keep their plain names.
"""

from dataclasses import dataclass
from typing import Self

from trundle.robots.model import JointType, Model, Sensor, World
from trundle.robots.names import ros_name
from trundle.robots.robot import Robot

WORLD_FRAME = "world"
_NO_TOPIC = ("__default__", "__default_topic__")
"""Values of <topic> in old files that mean the default topic."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkFrame:
    """One link in the tf tree."""

    frame: str
    parent: str
    link: int
    """Index into `Snapshot.poses`."""
    parent_link: int | None
    """None: the parent is the world."""
    is_moving: bool
    """True if its transform from the parent can change."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FrameNames:
    """Frame names of links and sensors."""

    plain: bool = False
    """True: a frame is its link's name, as for a single robot; False: `<model>/<link>`."""
    lumped: frozenset[str] = frozenset()
    """Links of the URDF, including lumped ones, which are not simulated."""

    @classmethod
    def from_world(cls, world: World, robot: Robot | None = None) -> Self:
        """Names for `trundle run`: of a world, or of a single robot."""
        return cls(plain=_has_plain_frames(world), lumped=_links_of(robot))

    @classmethod
    def from_robot(cls, robot: Robot) -> Self:
        """Names for a launch with one URDF, for which robot_state_publisher broadcasts the frames."""
        return cls(plain=True, lumped=_links_of(robot))

    def link(self, model: Model, link: str) -> str:
        """Frame of a link."""
        return ros_name(link) if self.plain else f"{ros_name(model.name)}/{ros_name(link)}"

    def sensor(self, model: Model, parent: str, sensor: Sensor, *, rest: str = "") -> str:
        """Frame of a sensor, distinct from the frames of other sensors and of links.

        If several sensors of the model have the same name, the link or joint is its prefix; if a link has the same
        name, its suffix is `_sensor`.

        Args:
            model: model of the sensor.
            parent: link or joint of the sensor.
            sensor: sensor of the frame.
            rest: suffix.
        """
        names = [ros_name(other.name) for owner in (*model.links, *model.joints) for other in owner.sensors]
        is_unique = names.count(ros_name(sensor.name)) <= 1
        frame = self.link(model, (sensor.name if is_unique else f"{parent}/{sensor.name}") + rest)
        is_link = frame in self.lumped or frame in (self.link(model, link.name) for link in model.links)
        return f"{frame}_sensor" if is_link else frame

    def find_link(self, model: Model, name: str) -> str | None:
        """Frame of the link of a name, simulated or in the URDF only; None if there is no such link."""
        frames = {name, self.link(model, name)}
        links = {self.link(model, link.name) for link in model.links} | self.lumped
        return next((frame for frame in sorted(frames) if frame in links), None)


def _links_of(robot: Robot | None) -> frozenset[str]:
    return frozenset() if robot is None else frozenset(ros_name(link.name) for link in robot.links)


def sensor_topic(model: Model, parent: str, sensor: Sensor, output: str, *, main: str, part: str = "") -> str:
    """Topic of a sensor's output: `/<model>/<parent>/<sensor>/<output>`, unless the file has a <topic>.

    A <topic> names the main output; camera_info is its sibling, as in gz, and other outputs are below it.

    Args:
        model: model of the sensor.
        parent: link or joint of the sensor.
        sensor: sensor of the topic.
        output: imu, scan, image_raw, …
        main: sensor's main output.
        part: camera of a multicamera.
    """
    parts = (part,) if part else ()
    base = sensor.topic.strip().removeprefix("~").strip("/")
    if not base or base in _NO_TOPIC:
        return "/" + "/".join(ros_name(name) for name in (model.name, parent, sensor.name, *parts, output))
    topic = global_topic("/".join((base, *parts)))
    if output == main and not part:
        return topic
    if output == "camera_info" and not part:
        return f"{topic.rpartition('/')[0]}/camera_info"
    return f"{topic}/{output}"


def global_topic(name: str) -> str:
    """Global topic of a name in a file, with or without a leading slash."""
    return f"/{ros_name(name.strip().removeprefix('~').strip('/'))}"


def _has_plain_frames(world: World) -> bool:
    """True if the file has a single robot, and `run` added the rest of the world."""
    return len([model for model in world.models if not model.added]) == 1 and any(m.added for m in world.models)


def link_frames(world: World) -> list[LinkFrame]:
    """Frames of all links of the world, in the order of `Snapshot.poses`."""
    names = FrameNames.from_world(world)
    frames: list[LinkFrame] = []
    for model in world.models:
        start = len(frames)
        index = {link.name: start + i for i, link in enumerate(model.links)}
        parent_joints = {joint.child: joint for joint in reversed(model.joints) if joint.parent in index}
        for link in model.links:
            joint = parent_joints.get(link.name)
            parent_link = None if joint is None else index[joint.parent]
            parent = WORLD_FRAME if joint is None else names.link(model, joint.parent)
            rigid = joint is not None and (
                joint.type is JointType.FIXED or (joint.axis is not None and joint.axis.is_rigid)
            )
            frames.append(
                LinkFrame(
                    frame=names.link(model, link.name),
                    parent=parent,
                    link=index[link.name],
                    parent_link=parent_link,
                    is_moving=not (rigid or model.static),
                )
            )
    return frames
