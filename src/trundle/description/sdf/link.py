"""Reads <link>: what is seen, touched, weighed and mounted."""

from trundle.model import Collision, Inertial, Link, Sensor, Visual
from trundle.spatial import Pose
from trundle.xmlnode import XmlNode

from .context import Context, read_pose
from .geometry import read_geometry
from .material import read_material
from .sensor import read_sensor
from .surface import read_surface


def read_link(node: XmlNode, name: str, model_from_link: Pose, context: Context) -> Link:
    """Read one link, whose pose in its model has been found."""
    report = context.report
    decay, collide = node.find("velocity_decay"), node.find("self_collide")
    link = Link(
        name=name,
        at=node.at,
        model_from_link=model_from_link,
        inertial=read_inertial(node, name, context),
        visuals=tuple(v for child in node.all("visual") if (v := _read_visual(child, context)) is not None),
        collisions=tuple(c for child in node.all("collision") if (c := _read_collision(child, context)) is not None),
        sensors=_read_sensors(node, context),
        gravity=node.flag("gravity", default=True, report=report),
        self_collide=None if collide is None else collide.as_flag(default=False, report=report),
        kinematic=node.flag("kinematic", default=False, report=report),
        linear_decay=0.0 if decay is None else decay.number("linear", default=0.0, report=report),
        angular_decay=0.0 if decay is None else decay.number("angular", default=0.0, report=report),
    )
    if link.kinematic:
        report.warn(node.at, f"link {name!r}: kinematic links are not simulated yet; it moves freely")
    if link.linear_decay or link.angular_decay:
        report.warn(node.at, f"link {name!r}: velocity_decay is not simulated yet; nothing slows it")
    node.report_unread(report)
    return link


def _read_sensors(node: XmlNode, context: Context) -> tuple[Sensor, ...]:
    return tuple(read_sensor(child, context) for child in node.all("sensor"))


def read_inertial(link: XmlNode, name: str, context: Context) -> Inertial:
    """Read a link's <inertial> as written; what physics cannot use is mended there."""
    node = link.find("inertial")
    if node is None:
        return Inertial()
    report = context.report
    mass = node.number("mass", default=1.0, report=report)
    inertia = node.find("inertia")
    if inertia is None:
        report.info(
            node.at,
            f"link {name!r}: {mass:g} kg without <inertia> turns like 1 kg·m² on every axis, as SDF says; rarely meant",
        )
        return Inertial(mass=mass, link_from_com=read_pose(node, context).pose)
    moments = tuple(inertia.number(tag, default=1.0, report=report) for tag in ("ixx", "iyy", "izz"))
    products = tuple(inertia.number(tag, default=0.0, report=report) for tag in ("ixy", "ixz", "iyz"))
    inertia.report_unread(report)
    pose = read_pose(node, context).pose
    node.report_unread(report)
    return Inertial(
        mass=mass,
        link_from_com=pose,
        moments=(moments[0], moments[1], moments[2]),
        products=(products[0], products[1], products[2]),
    )


def _read_visual(node: XmlNode, context: Context) -> Visual | None:
    geometry = read_geometry(node, context)
    if geometry is None:
        return None
    visual = Visual(
        name=node.attribute("name") or "visual",
        geometry=geometry,
        at=node.at,
        link_from_visual=read_pose(node, context).pose,
        material=read_material(node, context),
        transparency=min(max(node.number("transparency", default=0.0, report=context.report), 0.0), 1.0),
        cast_shadows=node.flag("cast_shadows", default=True, report=context.report),
    )
    node.find("laser_retro")
    node.report_unread(context.report)
    return visual


def _read_collision(node: XmlNode, context: Context) -> Collision | None:
    geometry = read_geometry(node, context)
    if geometry is None:
        return None
    collision = Collision(
        name=node.attribute("name") or "collision",
        geometry=geometry,
        at=node.at,
        link_from_collision=read_pose(node, context).pose,
        surface=read_surface(node, context),
    )
    node.find("max_contacts")  # ODE's; MuJoCo makes as many contacts as the shapes need
    node.find("laser_retro")
    node.report_unread(context.report)
    return collision
