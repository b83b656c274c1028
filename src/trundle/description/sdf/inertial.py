"""Reads <inertial>: what a link weighs and how it resists being turned."""

from trundle.model import Inertial
from trundle.xmlnode import XmlNode

from .context import Context, read_pose, warn_ignored


def read_inertial(link: XmlNode, name: str, context: Context) -> Inertial:
    """Read a link's <inertial> as written; what physics cannot use is mended there."""
    node = link.find("inertial")
    if node is None:
        return Inertial()
    report = context.report
    mass = node.number("mass", default=1.0, report=report)
    inertia = node.find("inertia")
    pose = read_pose(node, context).pose  # seen from the link always, whatever the file says
    warn_ignored(node, ("auto_inertia_params",), "is for calculators of one's own", context)
    node.find("density")  # for automatic inertias, which read it themselves
    node.attribute("auto")
    if inertia is None:
        report.info(
            node.at,
            f"link {name!r}: {mass:g} kg without <inertia> turns like 1 kg·m² on every axis, as SDF says; rarely meant",
        )
        node.report_unread(report)
        return Inertial(mass=mass, link_from_com=pose)
    ixx, iyy, izz = (inertia.number(tag, default=1.0, report=report) for tag in ("ixx", "iyy", "izz"))
    ixy, ixz, iyz = (inertia.number(tag, default=0.0, report=report) for tag in ("ixy", "ixz", "iyz"))
    inertia.report_unread(report)
    node.report_unread(report)
    return Inertial(mass=mass, link_from_com=pose, moments=(ixx, iyy, izz), products=(ixy, ixz, iyz))
