"""Reader of a URDF's <link> by urdfdom's rules."""

from typing import cast

from trundle.base.diagnostics import Diagnostics
from trundle.base.xmlnode import MAX_LENGTH, MAX_MASS, XmlNode

from .materials import Materials, RobotMaterial
from .urdf_tree import (
    RobotBox,
    RobotCylinder,
    RobotGeometry,
    RobotInertial,
    RobotLink,
    RobotMesh,
    RobotShape,
    RobotSphere,
)
from .values import read_number, read_origin, read_vector


def read_link(node: XmlNode, materials: Materials, report: Diagnostics) -> RobotLink:
    """Read one link as urdfdom does: after a fault the rest of the link is left out, but the link stays."""
    name = node.required_attribute("name")
    inertial, is_sound = _read_inertial(node, name, report)
    shapes: dict[str, list[RobotShape]] = {"visual": [], "collision": []}
    nodes = [*node.all("visual"), *node.all("collision")]
    read = 0
    while is_sound and read < len(nodes):
        child = nodes[read]
        shape = _read_shape(child, materials if child.tag == "visual" else None, report)
        is_sound = shape is not None
        read += 1
        if shape is not None:
            shapes[child.tag].append(shape)
    if nodes[read:]:
        skipped = ", ".join(dict.fromkeys(f"<{child.tag}>" for child in nodes[read:]))
        report.warn(
            nodes[read].at, f"link {name!r}: as by urdfdom, {skipped} after a fault is not read", "urdf-after-fault"
        )
    node.attributes()
    node.report_unread(report)
    return RobotLink(
        name=name,
        at=node.at,
        inertial=inertial,
        visuals=tuple(shapes["visual"]),
        collisions=tuple(shapes["collision"]),
    )


def _read_inertial(link: XmlNode, name: str, report: Diagnostics) -> tuple[RobotInertial | None, bool]:
    """Return a link's inertial, and False if it is incomplete; urdfdom keeps the mass of an incomplete inertia."""
    node = link.find("inertial")
    if node is None:
        return None, True
    mass_node, inertia = node.find("mass"), node.find("inertia")
    mass = None if mass_node is None else read_number(mass_node, "value", report, limit=MAX_MASS)
    if mass is None:
        report.warn(node.at, f"link {name!r}: <inertial> without a <mass value=…> is dropped", "incomplete-element")
        return None, False
    values: list[float | None] = [None]
    if inertia is not None:
        values = [read_number(inertia, key, report) for key in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")]
    is_whole = None not in values
    if not is_whole:
        reason = f"link {name!r}: <inertial> without a whole <inertia>; as by urdfdom, its mass of {mass:g} kg is kept"
        report.warn(node.at, f"{reason} and its inertia is zero", "incomplete-element")
    ixx, iyy, izz, ixy, ixz, iyz = cast(list[float], values) if is_whole else [0.0] * 6
    inertial = RobotInertial(
        mass=mass, link_from_com=read_origin(node, report), moments=(ixx, iyy, izz), products=(ixy, ixz, iyz)
    )
    return inertial, is_whole


def _read_shape(node: XmlNode, materials: Materials | None, report: Diagnostics) -> RobotShape | None:
    geometry = _read_geometry(node, report)
    if geometry is None:
        return None
    material = node.find("material")
    if material is not None and materials is not None and material.attribute("name") is None:
        material.mark_all_read()
        report.warn(
            material.at,
            "<material> without a name, a fault to urdfdom; as in Gazebo its <visual> is left out",
            "incomplete-element",
        )
        return None
    look = RobotMaterial() if material is None or materials is None else materials.find(material)
    shape = RobotShape(
        name=node.attribute("name") or "",
        geometry=geometry,
        at=node.at,
        link_from_shape=read_origin(node, report),
        rgba=look.rgba,
        texture=look.texture,
        material="" if material is None else material.attribute("name") or "",
    )
    node.report_unread(report)
    return shape


def _read_geometry(owner: XmlNode, report: Diagnostics) -> RobotGeometry | None:
    node = owner.find("geometry")
    if node is None or not node.children:
        report.warn(owner.at, f"<{owner.tag}> without a shape; it is left out", "incomplete-element")
        return None
    shape = node.children[0]
    node.find(shape.tag)
    match shape.tag:
        case "box":
            size = read_vector(shape, "size", report, limit=MAX_LENGTH)
            return None if size is None else RobotBox(size)
        case "cylinder":
            radius, length = (
                read_number(shape, "radius", report, limit=MAX_LENGTH),
                read_number(shape, "length", report, limit=MAX_LENGTH),
            )
            return None if radius is None or length is None else RobotCylinder(radius, length)
        case "sphere":
            radius = read_number(shape, "radius", report, limit=MAX_LENGTH)
            return None if radius is None else RobotSphere(radius)
        case "mesh":
            uri = shape.attribute("filename")
            if not uri:
                report.warn(shape.at, "<mesh> without a filename; it is left out", "incomplete-element")
                return None
            is_scaled = shape.attribute("scale") is not None
            scale = read_vector(shape, "scale", report, limit=MAX_LENGTH) if is_scaled else None
            return RobotMesh(uri, scale or (1.0, 1.0, 1.0))
        case other:
            report.warn(shape.at, f"<{other}> is not a URDF shape; this <{owner.tag}> is left out", "unsupported-shape")
            return None
