"""Reader of <surface>: contact parameters."""

from trundle.base.xmlnode import XmlNode
from trundle.robots.model import Surface

from .context import Context

_TUNING = (
    "soft_cfm",
    "soft_erp",
    "poissons_ratio",
    "elastic_modulus",
    "collide_without_contact_bitmask",
    "bullet",
    "soft_contact",
)
"""Parameters of Gazebo's engines only."""


def default_surface(context: Context) -> Surface:
    """Return the default surface: infinite friction before SDF 1.4, bitmask 1 in 1.4."""
    friction = -1.0 if context.version < (1, 4) else 1.0
    return Surface(mu=friction, mu2=friction, collide_bitmask=1 if context.version == (1, 4) else 0xFFFF)


def read_surface(node: XmlNode, context: Context) -> Surface:
    """Read friction, contact and restitution of a <surface> as written."""
    default, report = default_surface(context), context.report
    friction, contact, bounce = node.find("friction"), node.find("contact"), node.find("bounce")
    ode, contact_ode = _find(friction, "ode"), _find(contact, "ode")
    torsional = _find(friction, "torsional")
    torsional_ode = _find(torsional, "ode")

    def number(parent: XmlNode | None, tag: str, fallback: float) -> float:
        return fallback if parent is None else parent.number(tag, default=fallback)

    def integer(tag: str, fallback: int) -> int:
        return fallback if contact is None else contact.integer(tag, default=fallback)

    surface = Surface(
        mu=number(ode, "mu", default.mu),
        mu2=number(ode, "mu2", default.mu2),
        fdir1=default.fdir1 if ode is None else ode.vector("fdir1", default=default.fdir1),
        slip1=number(ode, "slip1", default.slip1),
        slip2=number(ode, "slip2", default.slip2),
        torsional_coefficient=number(torsional, "coefficient", default.torsional_coefficient),
        torsional_slip=number(torsional_ode, "slip", default.torsional_slip),
        patch_radius=number(torsional, "patch_radius", default.patch_radius),
        surface_radius=number(torsional, "surface_radius", default.surface_radius),
        use_patch_radius=torsional is None or torsional.flag("use_patch_radius", default=True),
        kp=number(contact_ode, "kp", default.kp),
        kd=number(contact_ode, "kd", default.kd),
        min_depth=number(contact_ode, "min_depth", default.min_depth),
        max_vel=number(contact_ode, "max_vel", default.max_vel),
        restitution=number(bounce, "restitution_coefficient", default.restitution),
        bounce_threshold=number(bounce, "threshold", default.bounce_threshold),
        collide_bitmask=integer("collide_bitmask", default.collide_bitmask),
        category_bitmask=integer("category_bitmask", 0xFFFF) if _find(contact, "category_bitmask") else None,
        collide_without_contact=contact is not None and contact.flag("collide_without_contact", default=False),
    )
    for element in (node, friction, ode, torsional, torsional_ode, contact, contact_ode, bounce):
        if element is not None:
            _name_tuning(element, context)
            element.report_unread(report)
    return surface


def _find(node: XmlNode | None, tag: str) -> XmlNode | None:
    return None if node is None else node.find(tag)


def _name_tuning(node: XmlNode, context: Context) -> None:
    for tag in _TUNING:
        child = node.find(tag)
        if child is not None and (child.children or child.text.strip("0.") != ""):
            context.report.info(
                child.at, f"<{tag}> in <{node.tag}> tunes Gazebo's engines; it is ignored", "engine-tuning"
            )
