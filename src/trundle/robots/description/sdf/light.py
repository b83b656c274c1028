"""Reader of <light>: directional, point or spot."""

from msgspec.structs import replace

from trundle.base.xmlnode import XmlNode
from trundle.robots.model import Light, LightType
from trundle.spatial import normalized

from .context import Context, read_pose, warn_ignored
from .frames import FrameGraph
from .material import read_colour

_TYPES: dict[str, LightType] = {"directional": "directional", "point": "point", "spot": "spot"}


def read_light(node: XmlNode, owner: str, graph: FrameGraph, context: Context) -> Light:
    """Read one light, posed in its owner's frame: a link's, or the world's."""
    report = context.report
    default = Light(name="", type="point", at=node.at)
    written = node.attribute("type") or "point"
    if written not in _TYPES:
        report.warn(node.at, f"no light type {written!r}; types: {', '.join(_TYPES)}; point is used")
    direction = normalized(node.vector("direction", default=default.direction))
    attenuation, spot = node.find("attenuation"), node.find("spot")

    def of(parent: XmlNode | None, tag: str, otherwise: float) -> float:
        return otherwise if parent is None else parent.number(tag, default=otherwise)

    light = Light(
        name=node.attribute("name") or "light",
        type=_TYPES.get(written, "point"),
        at=node.at,
        world_from_light=graph.pose_in(owner, read_pose(node, context), node.at),
        direction=direction or default.direction,
        diffuse=read_colour(node, "diffuse", default.diffuse, context),
        specular=read_colour(node, "specular", default.specular, context),
        intensity=node.number("intensity", default=1.0),
        range_m=of(attenuation, "range", default.range_m),
        constant=of(attenuation, "constant", default.constant),
        linear=of(attenuation, "linear", default.linear),
        quadratic=of(attenuation, "quadratic", default.quadratic),
        inner_angle_rad=of(spot, "inner_angle", 0.0),
        outer_angle_rad=of(spot, "outer_angle", 0.0),
        falloff=of(spot, "falloff", 0.0),
        cast_shadows=node.flag("cast_shadows", default=False),
    )
    if not node.flag("light_on", default=True):
        report.info(node.at, f"light {light.name!r} is off")
        light = replace(light, intensity=0.0)
    warn_ignored(node, ("visualize",), "has no effect: lights are not drawn", context)
    for each in (node, attenuation, spot):
        if each is not None:
            each.report_unread(report)
    return light
