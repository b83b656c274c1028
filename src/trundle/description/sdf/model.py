"""Reads <model>: its links and joints, with every pose resolved to the model's frame."""

from dataclasses import replace

from trundle.diagnostics import DescriptionError, Diagnostics
from trundle.model import Joint, Link, Model
from trundle.spatial import Pose
from trundle.xmlnode import XmlNode

from .context import Context, RawPose, read_pose
from .frames import MODEL, FrameGraph
from .joint import read_joint
from .link import read_link
from .sensor import read_plugin

WORLD = "world"


def read_model(node: XmlNode, context: Context, *, name: str | None = None, pose: Pose | None = None) -> Model:
    """Read one model; nested ones become part of it, their names joined by `::`.

    Args:
        node: the element.
        context: the file.
        name: in place of the model's own, as an <include> may say.
        pose: likewise.

    Raises:
        DescriptionError: a joint names no link, or a name is missing or taken twice.
    """
    own_name = node.required_attribute("name")
    report = context.report
    graph, links = FrameGraph(), dict[str, XmlNode]()
    _collect(node, context, graph, links)
    nested = [_read_nested(child, graph, context) for child in node.all("model")]
    known = [*links, *(link.name for inner in nested for link in inner.links)]
    for inner in nested:
        for link in inner.links:
            graph.add(link.name, RawPose(link.model_from_link), link.at)
    joints = [joint for joint in node.all("joint") if not _reaches_nothing(joint, known, report)]
    for joint in joints:
        child = _link_name(joint, "child", known)
        graph.add(_joint_frame(joint, links), read_pose(joint, context), joint.at, default=child)
    read_links = [read_link(n, k, graph.pose(k, n.at), context) for k, n in links.items()]
    read_joints = [_read_joint(joint, links, known, graph, context) for joint in joints]
    for inner in nested:
        read_links += inner.links
        read_joints += inner.joints
    model = Model(
        name=name or own_name,
        at=node.at,
        world_from_model=read_pose(node, context).pose if pose is None else pose,
        static=node.flag("static", default=False, report=report),
        self_collide=node.flag("self_collide", default=False, report=report),
        links=tuple(read_links),
        joints=tuple(read_joints),
        plugins=(*(read_plugin(tag) for tag in node.all("plugin")), *(p for inner in nested for p in inner.plugins)),
        canonical_link=node.attribute("canonical_link"),
    )
    if not model.links and not model.static:
        report.warn(node.at, f"model {model.name!r} has no links; nothing of it can move")
    node.find("pose")
    node.find("allow_auto_disable")
    node.report_unread(report)
    return model


def _collect(node: XmlNode, context: Context, graph: FrameGraph, links: dict[str, XmlNode]) -> None:
    for link in node.all("link"):
        name = link.required_attribute("name")
        if name in links:
            raise DescriptionError(link.at, f"a second link {name!r}; the first is at line {links[name].at.line}")
        links[name] = link
        graph.add(name, read_pose(link, context), link.at)
    for frame in node.all("frame"):
        name = frame.required_attribute("name")
        attached_to = frame.attribute("attached_to")
        graph.add(name, read_pose(frame, context), frame.at, default=attached_to or MODEL)


def _reaches_nothing(joint: XmlNode, known: list[str], report: Diagnostics) -> bool:
    """Whether a joint names a link of a nested model that is not there, as where an <include> was left out."""
    lost = [name for name in (joint.string("parent"), joint.string("child")) if "::" in name and name not in known]
    if lost:
        report.warn(joint.at, f"joint {joint.attribute('name')!r}: no link {lost[0]!r}; the joint is left out")
    return bool(lost)


def _joint_frame(joint: XmlNode, links: dict[str, XmlNode]) -> str:
    """A joint's name among the frames; before SDF 1.7 it may be a link's too, and then it is no frame to refer to."""
    name = joint.required_attribute("name")
    return f"joint {name}" if name in links else name


def _link_name(joint: XmlNode, tag: str, known: list[str]) -> str:
    name = joint.string(tag)
    who = f"joint {joint.attribute('name')!r}"
    if not name:
        raise DescriptionError(joint.at, f"{who} has no <{tag}>")
    if name in known or (name == WORLD and tag == "parent"):
        return name
    there = ", ".join(map(repr, known)) or "none"
    raise DescriptionError(joint.at, f"{who}: no link {name!r}; links here: {there}")


def _read_joint(
    node: XmlNode, links: dict[str, XmlNode], known: list[str], graph: FrameGraph, context: Context
) -> Joint:
    name = _joint_frame(node, links)
    parent, child = _link_name(node, "parent", known), _link_name(node, "child", known)
    if parent == child:
        raise DescriptionError(node.at, f"joint {node.attribute('name')!r} joins link {child!r} to itself")

    def frame(expressed_in: str, at: XmlNode) -> Pose:
        return graph.pose(expressed_in or name, at.at)

    child_from_joint = graph.pose(child, node.at).inverse() @ graph.pose(name, node.at)
    return read_joint(node, parent=parent, child=child, child_from_joint=child_from_joint, frame=frame, context=context)


def _read_nested(node: XmlNode, graph: FrameGraph, context: Context) -> Model:
    """A model inside a model, in the outer one's frame and with its name in front."""
    inner = read_model(node, context)
    raw = read_pose(node, context)
    graph.add(inner.name, raw, node.at)
    return moved_into(inner, graph.pose(inner.name, node.at))


def moved_into(inner: Model, outer_from_inner: Pose) -> Model:
    """The links and joints of a model as parts of another, by the names `inner::link`."""

    def named(name: str) -> str:
        return name if name == WORLD else f"{inner.name}::{name}"

    def turned(joint: Joint) -> Joint:
        axes = [
            None if axis is None else replace(axis, direction=outer_from_inner.direction(axis.direction))
            for axis in (joint.axis, joint.axis2)
        ]
        return replace(
            joint,
            name=named(joint.name),
            parent=named(joint.parent),
            child=named(joint.child),
            axis=axes[0],
            axis2=axes[1],
        )

    links = tuple[Link, ...](
        replace(link, name=named(link.name), model_from_link=outer_from_inner @ link.model_from_link)
        for link in inner.links
    )
    return replace(inner, links=links, joints=tuple(turned(joint) for joint in inner.joints))
