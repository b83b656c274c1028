"""Changes of SDF elements: pose, mass, friction, light."""

from collections.abc import Iterable

from trundle.base.xmlnode import XmlElement
from trundle.robots.model import Collision, Inertial, Light, Surface
from trundle.spatial import Pose

from ..writing.tag import Value, format_value


def put_value(home: XmlElement, tag: str, value: Value) -> XmlElement:
    """Set a child's text to a value."""
    return home.put(tag, format_value(value))


def set_pose(element: XmlElement, pose: Pose) -> None:
    """Set the pose of an element in its parent's frame."""
    element.set("placement_frame", None)
    if (placement := element.find("placement_frame")) is not None:
        placement.remove()
    child = element.find("pose")
    if child is None:
        index = next((i + 1 for i, sibling in enumerate(element.raw) if sibling.tag in ("name", "uri", "static")), 0)
        child = element.insert(XmlElement.parse("<pose/>"), at=min(index, len(element.raw)))
    for attribute in ("relative_to", "frame", "degrees", "rotation_format"):
        child.set(attribute, None)
    child.text = format_value(pose.as_list())


def set_inertial(link: XmlElement, inertial: Inertial) -> None:
    """Set mass and moments of a <link>; the centre of mass stays as written."""
    node = link.put("inertial")
    if node.get("auto") is not None:
        node.set("auto", None)
        set_pose(node, inertial.link_from_com)
    put_value(node, "mass", inertial.mass)
    inertia = node.put("inertia")
    for tag, value in zip(("ixx", "iyy", "izz"), inertial.moments, strict=True):
        put_value(inertia, tag, value)
    for tag, value in zip(("ixy", "ixz", "iyz"), inertial.products, strict=True):
        if value or inertia.find(tag) is not None:
            put_value(inertia, tag, value)


def set_friction(collision: XmlElement, surface: Surface) -> None:
    """Set the friction of a <collision>."""
    ode = collision.put("surface").put("friction").put("ode")
    put_value(ode, "mu", surface.mu)
    put_value(ode, "mu2", surface.mu2)


def set_frictions(link: XmlElement, current: Iterable[Collision], target: Iterable[Collision]) -> None:
    """Set the friction of those collisions of a <link> whose friction differs."""
    elements = {collision.get("name"): collision for collision in link.all("collision")}
    for before, after in zip(current, target, strict=False):
        same = (before.surface.mu, before.surface.mu2) == (after.surface.mu, after.surface.mu2)
        if not same and after.name in elements:
            set_friction(elements[after.name], after.surface)


def set_light(element: XmlElement, current: Light, target: Light) -> None:
    """Set color and intensity of a <light>."""
    if current.diffuse != target.diffuse:
        put_value(element, "diffuse", target.diffuse)
    if current.intensity != target.intensity:
        put_value(element, "intensity", target.intensity)
