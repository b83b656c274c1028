"""Reader of <road>."""

from trundle.base.xmlnode import XmlNode
from trundle.robots.model import Road
from trundle.spatial import Vector3

from .context import Context
from .material import named_material, read_material

_DEFAULT = "Gazebo/Road"


def read_road(node: XmlNode, context: Context) -> Road | None:
    """Read one <road>; None with a warning if its points form no line."""
    report = context.report
    name = node.required_attribute("name")
    points: list[Vector3] = []
    for child in node.all("point"):
        values = child.as_numbers(3, fallback="the point is left out")
        if values is not None:
            points.append((values[0], values[1], values[2]))
    width = node.number("width", default=1.0)
    has_material = node.find("material") is not None
    material = read_material(node, context) if has_material else named_material(_DEFAULT, node, context)
    node.report_unread(report)
    if len(points) < 2 or not width > 0.0:
        report.warn(
            node.at, f"<road> {name!r} needs two points and a width > 0 m; it is left out", "incomplete-element"
        )
        return None
    return Road(name=name, at=node.at, points=tuple(points), width=width, material=material)
