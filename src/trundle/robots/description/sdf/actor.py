"""Reader of <actor>."""

from pathlib import Path

from trundle.base.diagnostics import DescriptionError
from trundle.base.xmlnode import XmlNode
from trundle.robots.model import Actor, Animation, Joint, Skin, Trajectory, Waypoint
from trundle.spatial import Pose

from .context import Context, read_pose, warn_ignored
from .frames import MODEL, FrameGraph
from .link import read_link
from .model import JointElement
from .sensor import read_plugin


def read_actor(node: XmlNode, context: Context) -> Actor:
    """Read one <actor>.

    Raises:
        DescriptionError: a name is missing, or a joint names an unknown link.
    """
    report = context.report
    name = node.required_attribute("name")
    graph = FrameGraph(MODEL, report)
    links = {child.required_attribute("name"): child for child in node.all("link")}
    for link, child in links.items():
        graph.add(link, read_pose(child, context), child.at)
    warn_ignored(node, ("static",), "does not apply to actors", context)
    if node.attribute("static") is not None:
        report.info(node.at, f"attribute 'static' of actor {name!r} is ignored", "unsupported-attribute")
    script = node.find("script")
    actor = Actor(
        name=name,
        at=node.at,
        world_from_actor=read_pose(node, context).pose,
        skin=_skin(node.find("skin"), context),
        animations=tuple(_animation(child, context) for child in node.all("animation")),
        loop=script is None or script.flag("loop", default=True),
        delay_start_s=0.0 if script is None else script.number("delay_start", default=0.0),
        auto_start=script is None or script.flag("auto_start", default=True),
        trajectories=() if script is None else _trajectories(script, context),
        links=tuple(read_link(child, link, graph, context) for link, child in links.items()),
        joints=_joints(node, graph, context),
        plugins=tuple(read_plugin(tag) for tag in node.all("plugin")),
    )
    if script is not None:
        script.report_unread(report)
    node.report_unread(report)
    animations = {animation.name for animation in actor.animations}
    for trajectory in actor.trajectories:
        if animations and trajectory.type not in animations:
            available = ", ".join(map(repr, sorted(animations)))
            report.warn(
                node.at,
                f"actor {name!r}: no animation {trajectory.type!r}; animations here: {available}",
                "unknown-choice",
            )
    return actor


def _joints(node: XmlNode, graph: FrameGraph, context: Context) -> tuple[Joint, ...]:
    joints = [joint for child in node.all("joint") if (joint := JointElement(child, graph, context)).is_sound]
    for joint in joints:
        joint.add_to(graph)
    return tuple(joint.read(graph, context) for joint in joints)


def _skin(node: XmlNode | None, context: Context) -> Skin | None:
    if node is None:
        return None
    path, uri = _file(node, context)
    skin = Skin(path=path, uri=uri, scale=node.number("scale", default=1.0))
    node.report_unread(context.report)
    return skin


def _animation(node: XmlNode, context: Context) -> Animation:
    path, uri = _file(node, context)
    animation = Animation(
        name=node.attribute("name") or "",
        path=path,
        uri=uri,
        scale=node.number("scale", default=1.0),
        interpolate_x=node.flag("interpolate_x", default=False),
    )
    node.report_unread(context.report)
    return animation


def _file(node: XmlNode, context: Context) -> tuple[Path | None, str]:
    uri = node.string("filename")
    if not uri:
        context.report.warn(node.at, f"<{node.tag}> without <filename>; it is left out", "incomplete-element")
        return None, uri
    try:
        return context.packages.resolve(uri, folder=context.folder, at=node.at), uri
    except DescriptionError as error:
        context.report.warn(error.at, f"{error.what}; this <{node.tag}> is left out", error.id)
        return None, uri


def _trajectories(script: XmlNode, context: Context) -> tuple[Trajectory, ...]:
    report = context.report
    trajectories: list[Trajectory] = []
    for number, node in enumerate(script.all("trajectory")):
        id_text = node.attribute("id") or str(number)
        if not id_text.isdecimal():
            report.warn(node.at, f"<trajectory id={id_text!r}> needs a number; {number} is used", "invalid-value")
            id_text = str(number)
        tension = _tension(node, context)
        waypoints = [_waypoint(child, context) for child in node.all("waypoint")]
        trajectory = Trajectory(
            id=int(id_text),
            type=node.attribute("type") or "",
            tension=tension,
            waypoints=tuple(sorted(waypoints, key=lambda point: point.time_s)),
        )
        node.report_unread(report)
        trajectories.append(trajectory)
    return tuple(sorted(trajectories, key=lambda trajectory: trajectory.id))


def _tension(node: XmlNode, context: Context) -> float:
    text = node.attribute("tension")
    try:
        tension = 0.0 if text is None else float(text)
    except ValueError:
        tension = -1.0
    if 0.0 <= tension <= 1.0:
        return tension
    context.report.warn(node.at, f"<trajectory tension={text!r}> needs 0 to 1; 0 is used", "out-of-range")
    return 0.0


def _waypoint(node: XmlNode, context: Context) -> Waypoint:
    pose = node.find("pose")
    waypoint = Waypoint(
        time_s=node.number("time", default=0.0),
        pose=Pose() if pose is None else read_pose(node, context).pose,
    )
    node.report_unread(context.report)
    return waypoint
