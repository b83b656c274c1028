"""Reads a <joint> that stands outside its model, as in the tags of plugins that join links while the world runs."""

from pathlib import Path

from trundle.diagnostics import Diagnostics
from trundle.model import Joint, Model
from trundle.packages import Packages
from trundle.xmlnode import XmlNode

from .context import Context, RawPose
from .frames import MODEL, FrameGraph
from .model import JointElement
from .version import Version

_RULES = Version((1, 6))
"""Gazebo converts nothing inside a plugin's tag: it reads it by its own version's rules."""


def read_extra_joint(node: XmlNode, model: Model, report: Diagnostics) -> Joint | None:
    """Read a joint between links of a model, or one and the world; None where it joins no two, which was said.

    Raises:
        DescriptionError: it has no name or type, or names a link that is not there.
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
