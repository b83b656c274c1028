"""Reader of <model>: links, joints, frames and nested models, with all poses resolved to the model frame."""

from collections.abc import Iterable

from msgspec.structs import replace

from trundle.base.diagnostics import DescriptionError
from trundle.base.xmlnode import XmlNode
from trundle.robots.model import Frame, Joint, Model
from trundle.spatial import Pose

from .camera_labels import is_label, labelled
from .context import Context, read_pose
from .frames import MODEL, WORLD, FrameGraph
from .include import open_include, read_included_model
from .joint import TYPES, read_joint
from .link import read_link
from .merge import MergedModel, merge_model
from .sensor import read_plugin
from .unplaced_model import UnplacedModel

_DEEPEST = 200
"""Largest nesting depth of models."""


def read_model(node: XmlNode, context: Context, depth: int = 0) -> UnplacedModel:
    """Read one model with its nested and included models.

    Raises:
        DescriptionError: a name is missing, a joint names an unknown link, or models are nested too deeply.
    """
    if depth > _DEEPEST:
        raise DescriptionError(node.at, f"models nested more than {_DEEPEST} deep", "too-large")
    name = node.required_attribute("name")
    graph = FrameGraph(MODEL, context.report)
    links = placed_links(node.all("link"), graph, context)
    nested, merged = _nested(node, graph, context, depth)
    frames = read_frames(node, graph, context)
    graph.canonical_link = _canonical(node, links, nested, merged, graph)
    joints = [joint for child in node.all("joint") if (joint := JointElement(child, graph, context)).is_sound]
    for joint in joints:
        joint.add_to(graph)
    model = Model(
        name=name,
        at=node.at,
        static=node.flag("static", default=False),
        self_collide=node.flag("self_collide", default=False),
        allow_auto_disable=node.flag("allow_auto_disable", default=True),
        enable_wind=node.flag("enable_wind", default=False),
        links=tuple(read_link(child, link, graph, context) for link, child in links.items()),
        joints=tuple(joint.read(graph, context) for joint in joints),
        frames=tuple(replace(frame, model_from_frame=graph.pose(frame.name)) for frame in frames),
        models=tuple(replace(part.model, world_from_model=graph.pose(part.model.name)) for part in nested),
        plugins=tuple(read_plugin(tag) for tag in node.all("plugin") if not is_label(tag)),
    )
    model = labelled(model, node.all("plugin"), context)
    for merged_model in merged:
        model = merged_model.merge_into(model, graph)
    model = replace(model, canonical_link=graph.canonical_link)
    if model.canonical_link is None and not model.static:
        context.report.warn(node.at, f"model {name!r} has no links and cannot move", "no-links")
    raw = read_pose(node, context)
    if node.attribute("namespace"):
        context.report.info(
            node.at, f"attribute 'namespace' of model {name!r} is not supported; it is ignored", "unsupported-attribute"
        )
    placement = node.attribute("placement_frame") or ""
    node.report_unread(context.report)
    return UnplacedModel(model=model, scope=graph.scope(), raw=raw, placement_frame=placement)


def placed_links(nodes: Iterable[XmlNode], graph: FrameGraph, context: Context) -> dict[str, XmlNode]:
    """Return the <link>s of a model by name, and add their frames."""
    links: dict[str, XmlNode] = {}
    for child in nodes:
        name = child.required_attribute("name")
        if name in graph:
            after = f", after line {links[name].at.line}" if name in links else ""
            context.report.warn(child.at, f"a second link {name!r}{after}; it is left out", "duplicate-name")
            child.mark_all_read()
            continue
        links[name] = child
        graph.add(name, read_pose(child, context), child.at)
    return links


def _nested(
    node: XmlNode, graph: FrameGraph, context: Context, depth: int
) -> tuple[list[UnplacedModel], list[MergedModel]]:
    """Return the nested models in file order, and those to be merged."""
    parts: list[UnplacedModel] = []
    merged: list[MergedModel] = []
    for child in node.children:
        if child.tag == "model":
            part = read_model(child, context, depth + 1)
        elif child.tag == "include" and (opened := open_include(child, context)) is not None:
            root, inner = opened
            included = read_included_model(
                child, root, inner, context, lambda model, within: read_model(model, within, depth + 1)
            )
            if included is None:
                context.report.warn(
                    child.at, "no <model> in the included file; it is left out", "include-without-model"
                )
                continue
            part = included
        else:
            continue
        if part.merge:
            merged.append(merge_model(part, graph))
        elif any(part.model.name == other.model.name for other in parts):
            context.report.warn(
                part.model.at, f"a second nested model {part.model.name!r}; it is left out", "duplicate-name"
            )
        else:
            part.add_to(graph)
            parts.append(part)
    node.all("model")
    node.all("include")
    return parts, merged


def read_frames(node: XmlNode, graph: FrameGraph, context: Context) -> list[Frame]:
    """Read the <frame>s of a model or world, not yet posed."""
    frames: list[Frame] = []
    for child in node.all("frame"):
        name = child.required_attribute("name")
        if name in graph:
            context.report.warn(child.at, f"the name {name!r} is taken; this <frame> is left out", "duplicate-name")
            continue
        attached_to = child.attribute("attached_to") or graph.root
        graph.add(name, read_pose(child, context), child.at, default=attached_to, attached_to=attached_to)
        frames.append(Frame(name=name, at=child.at, attached_to=attached_to))
        child.report_unread(context.report)
    return frames


def _canonical(
    node: XmlNode,
    links: Iterable[str],
    nested: Iterable[UnplacedModel],
    merged: Iterable[MergedModel],
    graph: FrameGraph,
) -> str | None:
    """Return the canonical link: the named one, else the first, own links before those of nested models."""
    named = node.attribute("canonical_link")
    if named:
        if named in graph and (link := graph.link(named)) not in (None, MODEL):
            return link
        graph.report.warn(node.at, f"canonical_link {named!r}: no such link; the first one is taken", "missing-link")
    merged_models = [merged_model.part.model for merged_model in merged]
    inner = [*(part.model for part in nested), *(model for outer in merged_models for model in outer.models)]
    first = [*links, *(link.name for model in merged_models for link in model.links)]
    first += [f"{model.name}::{model.canonical_link}" for model in inner if model.canonical_link]
    return next(iter(first), None)


class JointElement:
    """<joint> whose links are known but whose pose is not."""

    def __init__(self, node: XmlNode, graph: FrameGraph, context: Context) -> None:
        self._node = node
        self._name = node.required_attribute("name")
        self._raw = read_pose(node, context)
        self._ends = [_end(node, tag) for tag in ("parent", "child")]
        # Before SDF 1.7 a joint may have a link's name, and then it is not a frame.
        self._frame = f"joint {self._name}" if self._name in graph else self._name
        self.is_sound = self._frame not in graph and self._has_valid_type(graph) and self._has_two_links(graph)
        if not self.is_sound:
            node.mark_all_read()

    def _has_valid_type(self, graph: FrameGraph) -> bool:
        type_ = self._node.required_attribute("type")
        if type_ in TYPES:
            return True
        why = f"joint {self._name!r}: no type {type_!r}; types: {', '.join(TYPES)}"
        graph.report.warn(self._node.at, f"{why}; as in Gazebo the joint is left out", "unknown-choice")
        return False

    def _has_two_links(self, graph: FrameGraph) -> bool:
        joint = f"joint {self._name!r}"
        for tag, end in zip(("parent", "child"), self._ends, strict=True):
            if not end:
                why = f"{joint} has no <{tag}>; Gazebo refuses the whole file"
            elif end != WORLD and end not in graph:
                why = f"{joint}: no link {end!r}; links here: {graph.names()}"
                if "::" not in end:  # otherwise it refers to a model whose <include> was left out
                    raise DescriptionError(self._node.at, why, "missing-link")
            else:
                continue
            graph.report.warn(self._node.at, f"{why}; the joint is left out", "missing-link")
            return False
        parent, child = (_link(end, graph) for end in self._ends)
        if parent == child:
            graph.report.warn(
                self._node.at, f"{joint} connects {parent!r} to itself; the joint is left out", "joint-to-itself"
            )
        return parent != child

    def add_to(self, graph: FrameGraph) -> None:
        """Add the joint's frame, which is relative to its child."""
        child = self._ends[1]
        default = graph.root if child == WORLD else child
        graph.add(self._frame, self._raw, self._node.at, default=default, attached_to=default)

    def read(self, graph: FrameGraph, context: Context) -> Joint:
        """Read the joint."""
        written_parent, written_child = self._ends
        parent, child = _link(written_parent, graph), _link(written_child, graph)
        model_from_joint = graph.pose(self._frame)
        model_from_child = Pose() if child == WORLD else graph.pose(child)

        def frame(expressed_in: str) -> Pose | None:
            if not expressed_in:
                return model_from_joint
            return graph.pose(expressed_in) if expressed_in in graph else None

        joint = read_joint(
            self._node,
            parent=parent,
            child=child,
            child_from_joint=model_from_child.inverse() @ model_from_joint,
            frame=frame,
            graph=graph,
            context=context,
        )
        return replace(
            joint,
            parent_frame=written_parent if written_parent != parent else None,
            child_frame=written_child if written_child != child else None,
        )


def _end(node: XmlNode, tag: str) -> str:
    """Return a joint's parent or child, which SDF 1.0 writes as an attribute."""
    child = node.find(tag)
    return "" if child is None else child.text or (child.attribute("link") or "")


def _link(name: str, graph: FrameGraph) -> str:
    """Return the link of a joint's parent or child; the model frame stands for its canonical link."""
    link = graph.link(name)
    if link == MODEL:
        link = graph.canonical_link
    return WORLD if link is None or link == graph.root else link
