"""Reads <surface>: what a collision is like to touch."""

from trundle.model import Surface
from trundle.xmlnode import XmlNode

from .context import Context


def read_surface(collision: XmlNode, context: Context) -> Surface:
    """Read friction, contact and bounce; what is not simulated is named."""
    node = collision.find("surface")
    # Friction defaulted to infinite before SDF 1.4, the bitmask to 1 in 1.4.
    friction = -1.0 if context.version < (1, 4) else 1.0
    bitmask = 1 if context.version == (1, 4) else 0xFFFF
    if node is None:
        return Surface(mu=friction, mu2=friction, collide_bitmask=bitmask)
    report = context.report
    ode = _descend(node, "friction", "ode")
    contact = node.find("contact")
    contact_ode = _descend(node, "contact", "ode")
    bounce = node.find("bounce")
    surface = Surface(
        mu=friction if ode is None else ode.number("mu", default=friction, report=report),
        mu2=friction if ode is None else ode.number("mu2", default=friction, report=report),
        fdir1=(0.0, 0.0, 0.0) if ode is None else ode.vector("fdir1", default=(0.0, 0.0, 0.0), report=report),
        kp=1e12 if contact_ode is None else contact_ode.number("kp", default=1e12, report=report),
        kd=1.0 if contact_ode is None else contact_ode.number("kd", default=1.0, report=report),
        min_depth=0.0 if contact_ode is None else contact_ode.number("min_depth", default=0.0, report=report),
        max_vel=0.01 if contact_ode is None else contact_ode.number("max_vel", default=0.01, report=report),
        restitution=0.0 if bounce is None else bounce.number("restitution_coefficient", default=0.0, report=report),
        bounce_threshold=100000.0 if bounce is None else bounce.number("threshold", default=100000.0, report=report),
        collide_bitmask=bitmask
        if contact is None
        else contact.integer("collide_bitmask", default=bitmask, report=report),
        collide_without_contact=contact is not None
        and contact.flag("collide_without_contact", default=False, report=report),
    )
    for each in (node, node.find("friction"), ode, contact, contact_ode, bounce):
        if each is not None:
            each.report_unread(report)
    return surface


def _descend(node: XmlNode, *tags: str) -> XmlNode | None:
    found: XmlNode | None = node
    for tag in tags:
        if found is None:
            return None
        found = found.find(tag)
    return found
