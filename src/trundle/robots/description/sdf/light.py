"""Reader of <light>: directional, point or spot."""

from msgspec.structs import replace

from trundle.base.xmlnode import XmlNode
from trundle.robots.model import Light, LightType
from trundle.spatial import normalized

from .context import Context, read_pose, warn_ignored
from .frames import FrameGraph
from .material import read_color

_TYPES: dict[str, LightType] = {"directional": "directional", "point": "point", "spot": "spot"}


def read_light(node: XmlNode, owner: str, graph: FrameGraph, context: Context) -> Light:
    """Read one light, posed in its owner's frame: a link's, or the world's."""
    report = context.report
    default = Light(name="", type="point", at=node.at)
    type_name = node.attribute("type") or "point"
    if type_name not in _TYPES:
        report.warn(
            node.at, f"no light type {type_name!r}; types: {', '.join(_TYPES)}; point is used", "unknown-choice"
        )
    direction = normalized(node.vector("direction", default=default.direction))
    attenuation, spot = node.find("attenuation"), node.find("spot")

    def number(parent: XmlNode | None, tag: str, fallback: float) -> float:
        return fallback if parent is None else parent.number(tag, default=fallback)

    light = Light(
        name=node.attribute("name") or "light",
        type=_TYPES.get(type_name, "point"),
        at=node.at,
        world_from_light=graph.pose_in(owner, read_pose(node, context), node.at),
        direction=direction or default.direction,
        diffuse=read_color(node, "diffuse", default.diffuse, context),
        specular=read_color(node, "specular", default.specular, context),
        intensity=node.number("intensity", default=1.0),
        range_m=number(attenuation, "range", default.range_m),
        constant=number(attenuation, "constant", default.constant),
        linear=number(attenuation, "linear", default.linear),
        quadratic=number(attenuation, "quadratic", default.quadratic),
        inner_angle_rad=number(spot, "inner_angle", 0.0),
        outer_angle_rad=number(spot, "outer_angle", 0.0),
        falloff=number(spot, "falloff", 0.0),
        cast_shadows=node.flag("cast_shadows", default=False),
    )
    if not node.flag("light_on", default=True):
        report.info(node.at, f"light {light.name!r} is off", "light-off")
        light = replace(light, intensity=0.0)
    warn_ignored(node, ("visualize",), "has no effect: lights are not drawn", context)
    for element in (node, attenuation, spot):
        if element is not None:
            element.report_unread(report)
    return light
