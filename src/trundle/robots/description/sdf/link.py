"""Reader of <link>: visuals, collisions, inertia, sensors and lights."""

from msgspec.structs import replace

from trundle.base.xmlnode import XmlNode
from trundle.robots.model import Collision, Link, Visual

from .auto_inertia import inertial_of_collisions
from .camera_labels import with_plugins
from .context import Context, read_bits, read_pose, warn_ignored
from .frames import FrameGraph
from .geometry import read_geometry
from .inertial import read_inertial
from .light import read_light
from .material import read_material
from .sensor import read_sensor, with_unique_names
from .surface import default_surface, read_surface


def read_link(node: XmlNode, name: str, graph: FrameGraph, context: Context) -> Link:
    """Read one link, whose pose in its model is known."""
    report = context.report
    decay = node.find("velocity_decay")
    link = Link(
        name=name,
        at=node.at,
        model_from_link=graph.pose(name),
        inertial=read_inertial(node, name, context),
        visuals=tuple(_read_visual(child, name, graph, context) for child in node.all("visual")),
        collisions=tuple(_read_collision(child, name, graph, context) for child in node.all("collision")),
        sensors=with_unique_names(
            (read_sensor(child, name, graph, context) for child in node.all("sensor")), name, context
        ),
        lights=tuple(read_light(child, name, graph, context) for child in node.all("light")),
        gravity=node.flag("gravity", default=True),
        self_collide=_flag(node, "self_collide"),
        enable_wind=_flag(node, "enable_wind"),
        kinematic=node.flag("kinematic", default=False),
        linear_decay=0.0 if decay is None else decay.number("linear", default=0.0),
        angular_decay=0.0 if decay is None else decay.number("angular", default=0.0),
    )
    inertial = node.find("inertial")
    if inertial is not None and (inertial.attribute("auto") or "").lower() in ("true", "1"):
        link = replace(link, inertial=inertial_of_collisions(link, node, context))
    warn_ignored(node, ("must_be_base_link",), "is for Simbody", context)
    node.report_unread(report)
    return link


def _flag(node: XmlNode, tag: str) -> bool | None:
    child = node.find(tag)
    return None if child is None else child.as_flag(default=False)


def _read_visual(node: XmlNode, link: str, graph: FrameGraph, context: Context) -> Visual:
    visual = Visual(
        name=node.attribute("name") or "visual",
        geometry=read_geometry(node, context),
        at=node.at,
        link_from_visual=graph.pose_in(link, read_pose(node, context), node.at),
        material=read_material(node, context),
    )
    return with_appearance(visual, node, context)


def with_appearance(visual: Visual, node: XmlNode, context: Context) -> Visual:
    """Return a visual with the properties of <visual> other than pose, shape and material."""
    report = context.report
    visual = replace(
        visual,
        transparency=min(max(node.number("transparency", default=visual.transparency), 0.0), 1.0),
        cast_shadows=node.flag("cast_shadows", default=visual.cast_shadows),
        laser_retro=node.number("laser_retro", default=visual.laser_retro),
        visibility_flags=read_bits(node, "visibility_flags", default=visual.visibility_flags),
    )
    warn_ignored(node, ("meta",), "is for Gazebo's editor", context)
    visual = with_plugins(visual, node.all("plugin"), context)
    node.report_unread(report)
    return visual


def _read_collision(node: XmlNode, link: str, graph: FrameGraph, context: Context) -> Collision:
    collision = Collision(
        name=node.attribute("name") or "collision",
        geometry=read_geometry(node, context),
        at=node.at,
        link_from_collision=graph.pose_in(link, read_pose(node, context), node.at),
        surface=default_surface(context),
    )
    warn_ignored(node, ("auto_inertia_params",), "is for custom inertia calculators", context)
    node.find("density")  # `auto_inertia` reads it
    return with_contact(collision, node, context)


def with_contact(collision: Collision, node: XmlNode, context: Context) -> Collision:
    """Return a collision with the properties of <collision> other than pose and shape."""
    surface = node.find("surface")
    collision = replace(
        collision,
        surface=collision.surface if surface is None else read_surface(surface, context),
        laser_retro=node.number("laser_retro", default=collision.laser_retro),
        max_contacts=node.integer("max_contacts", default=collision.max_contacts),
    )
    warn_ignored(node, ("max_contacts",), "is for ODE; MuJoCo creates as many contacts as needed", context)
    node.report_unread(context.report)
    return collision
