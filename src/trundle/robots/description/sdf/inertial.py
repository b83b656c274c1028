"""Reader of <inertial>."""

from trundle.base.xmlnode import MAX_MASS, XmlNode
from trundle.robots.model import Inertial

from .context import Context, read_pose, warn_ignored


def read_inertial(link: XmlNode, name: str, context: Context) -> Inertial:
    """Read a link's <inertial> as written; physics replaces unusable values."""
    node = link.find("inertial")
    if node is None:
        return Inertial()
    report = context.report
    mass = node.number("mass", default=1.0, limit=MAX_MASS)
    inertia = node.find("inertia")
    pose = read_pose(node, context).pose  # the pose is always in the link frame; relative_to is ignored
    warn_ignored(node, ("auto_inertia_params",), "is for custom inertia calculators", context)
    node.find("density")  # `auto_inertia` reads it
    node.attribute("auto")
    if inertia is None:
        report.info(
            node.at,
            f"link {name!r}: {mass:g} kg without <inertia>; SDF's default of 1 kg·m² is used, rarely intended",
            "default-inertia",
        )
        node.report_unread(report)
        return Inertial(mass=mass, link_from_com=pose)
    ixx, iyy, izz = (inertia.number(tag, default=1.0) for tag in ("ixx", "iyy", "izz"))
    ixy, ixz, iyz = (inertia.number(tag, default=0.0) for tag in ("ixy", "ixz", "iyz"))
    inertia.report_unread(report)
    node.report_unread(report)
    return Inertial(mass=mass, link_from_com=pose, moments=(ixx, iyy, izz), products=(ixy, ixz, iyz))
