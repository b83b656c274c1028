"""Reader of a <joint> outside its model, as in tags of plugins that attach links at run time."""

from pathlib import Path

from trundle.base.diagnostics import Diagnostics
from trundle.base.xmlnode import XmlNode
from trundle.robots.model import Joint, Model
from trundle.robots.packages import Packages

from .context import Context, RawPose
from .frames import MODEL, FrameGraph
from .model import JointElement
from .version import Version

_RULES = Version((1, 6))
"""Version of Gazebo 11, which does not convert the content of plugin tags."""


def read_extra_joint(node: XmlNode, model: Model, report: Diagnostics) -> Joint | None:
    """Read a joint between links of a model, or a link and the world; None with a warning if it is unusable.

    Raises:
        DescriptionError: it has no name or type, or names an unknown link.
    """
    folder = Path(node.at.file).parent
    context = Context(version=_RULES, folder=folder, packages=Packages({}, start=folder), report=report)
    graph = FrameGraph(MODEL, report, model.canonical_link)
    for link in model.links:
        graph.add(link.name, RawPose(link.model_from_link), link.at)
    joint = JointElement(node, graph, context)
    if not joint.is_sound:
        return None
    joint.add_to(graph)
    return joint.read(graph, context)
