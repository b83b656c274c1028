"""Reads a URDF by urdfdom's rules."""

import math
from typing import cast, get_args

from trundle.diagnostics import DescriptionError, Diagnostics
from trundle.spatial import Pose, Vector3
from trundle.xmlnode import XmlNode, parse_numbers

from .materials import Look, Materials
from .robot import (
    JointLimit,
    Mimic,
    Robot,
    RobotBox,
    RobotCylinder,
    RobotGeometry,
    RobotInertial,
    RobotJoint,
    RobotJointType,
    RobotLink,
    RobotMesh,
    RobotShape,
    RobotSphere,
)

_TYPES: tuple[str, ...] = get_args(RobotJointType)
_LIMITED = ("revolute", "prismatic")
_FOR_OTHERS = ("gazebo", "transmission")
"""Children of <robot> that the conversion to SDF and ros_control read."""


def read_robot(root: XmlNode, report: Diagnostics) -> Robot:
    """Read <robot>.

    Raises:
        DescriptionError: no tree: a joint names no link, a link has two parents, there is no root or several; or a
            limit that urdfdom requires is missing.
    """
    if root.tag != "robot":
        raise DescriptionError(root.at, f"a URDF starts with <robot>, not <{root.tag}>")
    name = root.attribute("name")
    if not name:
        raise DescriptionError(root.at, "<robot> needs a name")
    materials = Materials(root.all("material"), report)
    link_nodes = root.all("link")
    links = [_read_link(node, materials, report) for node in link_nodes]
    joints = [_read_joint(node, report) for node in root.all("joint")]
    for tag in _FOR_OTHERS:
        root.all(tag)
    root.attributes()
    root.report_unread(report)
    first = _root(root, links, joints)
    reached = _reached(first, joints)
    ring = [link for link in links if link.name not in reached]
    if ring:
        names = ", ".join(repr(link.name) for link in ring[:5])
        report.warn(ring[0].at, f"links {names} form a ring that no joint leads to; as urdfdom does, they are left out")
    return Robot(
        name=name,
        at=root.at,
        root=first,
        links=tuple(link for link in links if link.name in reached),
        joints=tuple(joint for joint in joints if joint.child in reached),
    )


def _root(node: XmlNode, links: list[RobotLink], joints: list[RobotJoint]) -> str:
    if not links:
        raise DescriptionError(node.at, "the robot has no links; was a xacro macro never called?")
    names: dict[str, RobotLink] = {}
    for link in links:
        if link.name in names:
            raise DescriptionError(link.at, f"a second link {link.name!r}; the first is at {names[link.name].at}")
        names[link.name] = link
    parents: dict[str, RobotJoint] = {}
    taken: set[str] = set()
    for joint in joints:
        if joint.name in taken:
            raise DescriptionError(joint.at, f"a second joint {joint.name!r}")
        taken.add(joint.name)
        for role, link in (("parent", joint.parent), ("child", joint.child)):
            if link not in names:
                there = ", ".join(map(repr, names))
                raise DescriptionError(joint.at, f"joint {joint.name!r}: no {role} link {link!r}; links here: {there}")
        if joint.child in parents:
            other = parents[joint.child].name
            raise DescriptionError(joint.at, f"link {joint.child!r} has two parents, by {other!r} and {joint.name!r}")
        parents[joint.child] = joint
    roots = [name for name in names if name not in parents]
    if not roots:
        raise DescriptionError(node.at, "the joints form a ring: every link is some joint's child")
    if len(roots) > 1:
        raise DescriptionError(
            node.at, f"more than one root link: {', '.join(map(repr, roots))}; joints must join them"
        )
    return roots[0]


def _reached(root: str, joints: list[RobotJoint]) -> set[str]:
    """The root and every link below it."""
    below: dict[str, list[str]] = {}
    for joint in joints:
        below.setdefault(joint.parent, []).append(joint.child)
    reached, pending = {root}, [root]
    while pending:
        children = below.get(pending.pop(), [])
        reached.update(children)
        pending += children
    return reached


def _read_link(node: XmlNode, materials: Materials, report: Diagnostics) -> RobotLink:
    name = node.required_attribute("name")
    link = RobotLink(
        name=name,
        at=node.at,
        inertial=_read_inertial(node, name, report),
        visuals=tuple(s for n in node.all("visual") if (s := _read_shape(n, materials, report)) is not None),
        collisions=tuple(s for n in node.all("collision") if (s := _read_shape(n, None, report)) is not None),
    )
    node.attributes()
    node.report_unread(report)
    return link


def _read_inertial(link: XmlNode, name: str, report: Diagnostics) -> RobotInertial | None:
    """Where anything required is missing the whole element is dropped, as urdfdom does."""
    node = link.find("inertial")
    if node is None:
        return None
    mass, inertia = node.find("mass"), node.find("inertia")
    if mass is None or inertia is None:
        missing = "<mass>" if mass is None else "<inertia>"
        report.warn(node.at, f"link {name!r}: <inertial> without {missing} is dropped")
        return None
    values = [_number(mass, "value", report)]
    values += [_number(inertia, key, report) for key in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")]
    if any(value is None for value in values):
        report.warn(node.at, f"link {name!r}: <inertial> is dropped")
        return None
    numbers = cast(list[float], values)
    return RobotInertial(
        mass=numbers[0],
        link_from_com=_read_origin(node, report),
        moments=(numbers[1], numbers[2], numbers[3]),
        products=(numbers[4], numbers[5], numbers[6]),
    )


def _read_shape(node: XmlNode, materials: Materials | None, report: Diagnostics) -> RobotShape | None:
    geometry = _read_geometry(node, report)
    if geometry is None:
        return None
    material = node.find("material")
    look = Look() if material is None or materials is None else materials.look(material)
    shape = RobotShape(
        name=node.attribute("name") or "",
        geometry=geometry,
        at=node.at,
        link_from_shape=_read_origin(node, report),
        rgba=look.rgba,
        texture=look.texture,
        material="" if material is None else material.attribute("name") or "",
    )
    node.report_unread(report)
    return shape


def _read_geometry(owner: XmlNode, report: Diagnostics) -> RobotGeometry | None:
    node = owner.find("geometry")
    if node is None or not node.children:
        report.warn(owner.at, f"<{owner.tag}> without a shape; it is left out")
        return None
    shape = node.children[0]
    node.find(shape.tag)
    match shape.tag:
        case "box":
            size = _vector(shape, "size", report)
            return None if size is None else RobotBox(size)
        case "cylinder":
            radius, length = _number(shape, "radius", report), _number(shape, "length", report)
            return None if radius is None or length is None else RobotCylinder(radius, length)
        case "sphere":
            radius = _number(shape, "radius", report)
            return None if radius is None else RobotSphere(radius)
        case "mesh":
            uri = shape.attribute("filename")
            if not uri:
                report.warn(shape.at, "<mesh> without a filename; it is left out")
                return None
            scale = (1.0, 1.0, 1.0) if shape.attribute("scale") is None else _vector(shape, "scale", report)
            return RobotMesh(uri, scale or (1.0, 1.0, 1.0))
        case other:
            report.warn(shape.at, f"<{other}> is no URDF shape; this <{owner.tag}> is left out")
            return None


def _read_joint(node: XmlNode, report: Diagnostics) -> RobotJoint:
    name = node.required_attribute("name")
    type_ = node.required_attribute("type")
    if type_ not in _TYPES:
        raise DescriptionError(node.at, f"joint {name!r}: no type {type_!r}; types: {', '.join(_TYPES)}")
    ends = {tag: node.find(tag) for tag in ("parent", "child")}
    links = {tag: "" if end is None else end.attribute("link") or "" for tag, end in ends.items()}
    for tag, link in links.items():
        if not link:
            raise DescriptionError(node.at, f"joint {name!r} has no <{tag} link=…>")
    dynamics = node.find("dynamics")
    joint = RobotJoint(
        name=name,
        type=cast(RobotJointType, type_),
        parent=links["parent"],
        child=links["child"],
        at=node.at,
        parent_from_joint=_read_origin(node, report),
        axis=_read_axis(node, name, type_, report),
        limit=_read_limit(node, name, type_, report),
        damping=_optional(dynamics, "damping", 0.0, report),
        friction=_optional(dynamics, "friction", 0.0, report),
        mimic=_read_mimic(node, name, report),
    )
    for tag in ("safety_controller", "calibration"):  # ros_control's and real hardware's
        node.find(tag)
    node.report_unread(report)
    return joint


def _read_axis(node: XmlNode, name: str, type_: str, report: Diagnostics) -> Vector3:
    axis = node.find("axis")
    if axis is None or type_ in ("fixed", "floating"):
        return (1.0, 0.0, 0.0)
    vector = _vector(axis, "xyz", report)
    if vector is None:
        return (1.0, 0.0, 0.0)
    if not any(vector):
        report.warn(axis.at, f"joint {name!r}: an axis of no length; 1 0 0 is used")
        return (1.0, 0.0, 0.0)
    return vector


def _read_limit(node: XmlNode, name: str, type_: str, report: Diagnostics) -> JointLimit | None:
    limit = node.find("limit")
    if limit is None:
        if type_ in _LIMITED:
            raise DescriptionError(node.at, f"joint {name!r}: a {type_} joint needs <limit effort= velocity=>")
        return None
    for key in ("effort", "velocity"):
        if limit.attribute(key) is None:
            raise DescriptionError(limit.at, f"joint {name!r}: <limit> needs {key!r}")
    return JointLimit(
        lower=_optional(limit, "lower", 0.0, report),
        upper=_optional(limit, "upper", 0.0, report),
        effort=_optional(limit, "effort", 0.0, report),
        velocity=_optional(limit, "velocity", 0.0, report),
    )


def _read_mimic(node: XmlNode, name: str, report: Diagnostics) -> Mimic | None:
    mimic = node.find("mimic")
    if mimic is None:
        return None
    leader = mimic.attribute("joint")
    if not leader:
        raise DescriptionError(mimic.at, f"joint {name!r}: <mimic> names no joint")
    return Mimic(
        joint=leader,
        multiplier=_optional(mimic, "multiplier", 1.0, report),
        offset=_optional(mimic, "offset", 0.0, report),
    )


def _read_origin(node: XmlNode, report: Diagnostics) -> Pose:
    origin = node.find("origin")
    if origin is None:
        return Pose()
    parts: list[Vector3] = []
    for key in ("xyz", "rpy"):
        vector = (0.0, 0.0, 0.0) if origin.attribute(key) is None else _vector(origin, key, report)
        parts.append(vector or (0.0, 0.0, 0.0))
    return Pose.from_rpy(*parts[0], *parts[1])


def _vector(node: XmlNode, key: str, report: Diagnostics) -> Vector3 | None:
    text = node.attribute(key)
    values = parse_numbers(text or "")
    if values is None or len(values) != 3 or not all(map(math.isfinite, values)):
        report.warn(node.at, f"<{node.tag} {key}={text!r}> wants three numbers; it is ignored")
        return None
    return (values[0], values[1], values[2])


def _number(node: XmlNode, key: str, report: Diagnostics) -> float | None:
    text = node.attribute(key)
    values = parse_numbers(text or "")
    if values is None or len(values) != 1 or not math.isfinite(values[0]):
        report.warn(node.at, f"<{node.tag} {key}={text!r}> wants one number")
        return None
    return values[0]


def _optional(node: XmlNode | None, key: str, default: float, report: Diagnostics) -> float:
    if node is None or node.attribute(key) is None:
        return default
    value = _number(node, key, report)
    return default if value is None else value
