"""Mass and inertia of links, computed from the shapes of their collisions."""

from trundle.base.xmlnode import XmlElement
from trundle.robots.description import enclosed_volume, uniform_inertial
from trundle.robots.model import Inertial, Link

from .field import number_text

_TENSOR = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")


def density_of(link: Link) -> float | None:
    """Return the density of a link [kg/m³]; None if its collisions have no volume."""
    volume = enclosed_volume(link.collisions)
    return link.inertial.mass / volume if volume else None


def weigh(element: XmlElement, link: Link, *, mass: float | None = None, density: float | None = None) -> None:
    """Write mass and inertia of a <link>; without a volume, only the mass.

    Args:
        element: link's element.
        link: link as read from the element.
        mass: [kg]; None: computed from the density.
        density: [kg/m³]
    """
    if mass is None:
        mass = (density or 0.0) * (enclosed_volume(link.collisions) or 0.0)
    inertial = uniform_inertial(link.collisions, mass)
    if inertial is None:
        element.put("inertial").put("mass", number_text([mass]))
    else:
        _write(element.put("inertial"), inertial)


def _write(node: XmlElement, inertial: Inertial) -> None:
    node.set("auto", None)
    pose = inertial.link_from_com.as_list()
    if any(pose) or node.find("pose") is not None:
        node.put("pose", number_text(pose)).set("relative_to", None)
    node.put("mass", number_text([inertial.mass]))
    inertia = node.put("inertia")
    for name, value in zip(_TENSOR, (*inertial.moments, *inertial.products), strict=True):
        if value or inertia.find(name) is not None or name[1] == name[2]:
            inertia.put(name, number_text([value]))
