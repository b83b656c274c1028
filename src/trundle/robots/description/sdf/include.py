"""Reader of <include>: a model from another file, with overrides."""

from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

from msgspec.structs import replace

from trundle.base.diagnostics import DescriptionError, UsageError
from trundle.base.xmlnode import ReadBudgetError, XmlNode, read_xml
from trundle.robots.model import Model, model_from_joint
from trundle.robots.packages import model_file

from .context import DEEPEST, Context, RawPose, read_pose
from .frames import MODEL, FrameGraph
from .params import apply_params
from .required import name_missing_attributes
from .sensor import read_plugin
from .unplaced_model import UnplacedModel
from .version import read_version

_DEEPEST_INCLUDE = 16
ReadModel: TypeAlias = Callable[[XmlNode, Context], UnplacedModel]


def open_include(node: XmlNode, context: Context) -> tuple[XmlNode, Context] | None:
    """Return the root element of an included file; None with a warning if it is missing, as in Gazebo.

    Raises:
        ReadBudgetError: the included files exhaust the budget.
    """
    report = context.report
    uri = node.string("uri") or (node.attribute("filename") or "")
    if not uri:
        report.warn(node.at, "<include> without <uri>; it is left out", "incomplete-element")
        return None
    try:
        path = context.packages.resolve(uri, folder=context.folder, at=node.at)
        file = model_file(path, report) if path.is_dir() else path
        return _root(file, node, context)
    except ReadBudgetError as error:
        raise error.through(map(str, context.including)) from None
    except (DescriptionError, UsageError) as error:
        elsewhere = isinstance(error, DescriptionError) and error.at != node.at
        report.warn_error(
            error,
            node.at,
            f"the <include>{f' on line {node.at.line}' if elsewhere else ''} is left out",
            "missing-model",
        )
        return None


def read_included_model(
    node: XmlNode, root: XmlNode, inner: Context, context: Context, read_model: ReadModel
) -> UnplacedModel | None:
    """Return the model of an opened <include>; None if it contains none."""
    if root.tag == "robot" and inner.read_urdf is not None:
        try:
            robot = inner.read_urdf(inner.including[-1], root)
        except DescriptionError as error:
            inner.report.warn(error.at, f"{error.what}; the <include> is left out", error.id)
            return None
        return _with_overrides(_robot(robot, inner), node, context)
    models = root.all("model")
    if not models:
        return None
    if len(models) > 1:
        inner.report.warn(
            models[1].at, "a second <model> in the file; an <include> takes the first", "duplicate-element"
        )
    apply_params(node, models[0], context.report)
    part = read_model(models[0], inner)
    return _with_overrides(part, node, context)


def _with_overrides(part: UnplacedModel, node: XmlNode, context: Context) -> UnplacedModel:
    name, static = node.string("name"), node.find("static")
    has_pose, placement = node.find("pose") is not None, node.string("placement_frame")
    model = replace(
        part.model,
        name=name or part.model.name,
        static=part.model.static if static is None else static.as_flag(default=False),
        plugins=(*part.model.plugins, *(read_plugin(tag) for tag in node.all("plugin"))),
    )
    # A pose or placement in the model's own file has no frame here; Gazebo keeps its numbers.
    raw = read_pose(node, context) if has_pose or placement else RawPose(part.raw.pose)
    merge = (node.attribute("merge") or "").lower() in ("true", "1")
    node.report_unread(context.report)
    return replace(part, model=model, raw=raw, placement_frame=placement or part.placement_frame, merge=merge)


def _root(file: Path, node: XmlNode, context: Context) -> tuple[XmlNode, Context]:
    if file.resolve() in context.including or len(context.including) > _DEEPEST_INCLUDE:
        raise DescriptionError(node.at, f"{file} includes itself", "include-cycle")
    root = read_xml(file, report=context.report, max_depth=DEEPEST, budget=context.budget, at=node.at)
    if root.tag == "robot":
        return root, context.for_include(file, context.version)
    if root.tag != "sdf":
        raise DescriptionError(
            root.at, f"<{root.tag}> starts neither an SDF (<sdf>) nor a URDF (<robot>)", "wrong-root"
        )
    version = read_version(root, context.report)
    name_missing_attributes(root, version, context.report)
    return root, context.for_include(file, version)


def _robot(model: Model, context: Context) -> UnplacedModel:
    """Return a converted URDF with its links and frames as a scope."""
    graph = FrameGraph(MODEL, context.report, model.canonical_link)
    for link in model.links:
        graph.add(link.name, RawPose(link.model_from_link), link.at)
    for frame in model.frames:
        graph.add(frame.name, RawPose(frame.model_from_frame), frame.at, attached_to=frame.attached_to)
    for joint in model.joints:
        if joint.name not in graph:
            graph.add(joint.name, RawPose(model_from_joint(model, joint)), joint.at, attached_to=joint.child)
    return UnplacedModel(model=model, scope=graph.scope(), raw=RawPose())
