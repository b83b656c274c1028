"""Reader of URDF by urdfdom's rules."""

from typing import cast, get_args

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.base.xmlnode import XmlNode
from trundle.spatial import Vector3

from .link import read_link
from .materials import Materials
from .urdf_tree import JointLimit, Robot, RobotJoint, RobotJointType, RobotLink, RobotMimic, RobotSafety
from .values import read_optional, read_origin, read_vector

_TYPES: tuple[str, ...] = get_args(RobotJointType)
_LIMITED = ("revolute", "prismatic")
_UNREAD_TAGS = ("gazebo", "transmission")
"""Children of <robot> that other readers use: the conversion to SDF, and ros_control."""


def read_robot(root: XmlNode, report: Diagnostics) -> Robot:
    """Read <robot>.

    Raises:
        DescriptionError: the links form no tree (unknown link, two parents, no or several roots), or a limit that
            urdfdom requires is missing.
    """
    if root.tag != "robot":
        raise DescriptionError(root.at, f"a URDF starts with <robot>, not <{root.tag}>", "wrong-root")
    name = root.attribute("name")
    if not root.all("link"):
        reason = "the robot has no links; is it a part to include, or was a xacro macro never called?"
        raise DescriptionError(root.at, reason, "no-links")
    if not name:
        raise DescriptionError(
            root.at, "<robot> needs a name; is it a part to include, not a robot?", "missing-attribute"
        )
    version = root.attribute("version")
    if version is not None and version != "1.0":
        report.warn(root.at, f"version {version!r}: urdfdom 3 refuses any but 1.0; it is read as that", "urdf-version")
    materials = Materials(root.all("material"), report)
    link_nodes = root.all("link")
    links = [read_link(node, materials, report) for node in link_nodes]
    joints = [_read_joint(node, report) for node in root.all("joint")]
    for tag in _UNREAD_TAGS:
        root.all(tag)
    for control in root.all("ros2_control"):
        control.mark_all_read()
        reason = "<ros2_control> is ROS 2's: nothing drives its joints; ROS 1 has <transmission> for each joint"
        report.warn(
            control.at,
            f"{reason}, the plugin libgazebo_ros_control.so and controllers in a launch file",
            "ros2-control",
        )
    root.attributes()
    root.report_unread(report)
    root_link = _root(root, links, joints)
    reached = _reached(root_link, joints)
    loop = [link for link in links if link.name not in reached]
    if loop:
        names = ", ".join(repr(link.name) for link in loop[:5])
        report.warn(
            loop[0].at,
            f"links {names} form a loop apart from the root; as urdfdom does, they are left out",
            "urdf-tree",
        )
    return Robot(
        name=name,
        at=root.at,
        root=root_link,
        links=tuple(link for link in links if link.name in reached),
        joints=tuple(joint for joint in joints if joint.child in reached),
    )


def _root(node: XmlNode, links: list[RobotLink], joints: list[RobotJoint]) -> str:
    names: dict[str, RobotLink] = {}
    for link in links:
        if link.name in names:
            raise DescriptionError(
                link.at, f"a second link {link.name!r}; the first is at {names[link.name].at}", "duplicate-name"
            )
        names[link.name] = link
    parents: dict[str, RobotJoint] = {}
    joint_names: set[str] = set()
    for joint in joints:
        if joint.name in joint_names:
            raise DescriptionError(joint.at, f"a second joint {joint.name!r}", "duplicate-name")
        joint_names.add(joint.name)
        for role, link in (("parent", joint.parent), ("child", joint.child)):
            if link not in names:
                listed = ", ".join(map(repr, names))
                raise DescriptionError(
                    joint.at, f"joint {joint.name!r}: no {role} link {link!r}; links here: {listed}", "missing-link"
                )
        if joint.child in parents:
            other = parents[joint.child].name
            raise DescriptionError(
                joint.at, f"link {joint.child!r} has two parents, by {other!r} and {joint.name!r}", "urdf-tree"
            )
        parents[joint.child] = joint
    roots = [name for name in names if name not in parents]
    if not roots:
        raise DescriptionError(node.at, "the joints form a loop: every link is some joint's child", "urdf-tree")
    if len(roots) > 1:
        raise DescriptionError(
            node.at, f"more than one root link: {', '.join(map(repr, roots))}; joints must join them", "urdf-tree"
        )
    return roots[0]


def _reached(root: str, joints: list[RobotJoint]) -> set[str]:
    """Return the root and every link below it."""
    children_of: dict[str, list[str]] = {}
    for joint in joints:
        children_of.setdefault(joint.parent, []).append(joint.child)
    reached, pending = {root}, [root]
    while pending:
        children = children_of.get(pending.pop(), [])
        reached.update(children)
        pending += children
    return reached


def _read_joint(node: XmlNode, report: Diagnostics) -> RobotJoint:
    name = node.required_attribute("name")
    type_ = node.required_attribute("type")
    if type_ not in _TYPES:
        raise DescriptionError(
            node.at, f"joint {name!r}: no type {type_!r}; types: {', '.join(_TYPES)}", "unknown-choice"
        )
    ends = {tag: node.find(tag) for tag in ("parent", "child")}
    links = {tag: "" if end is None else end.attribute("link") or "" for tag, end in ends.items()}
    for tag, link in links.items():
        if not link:
            raise DescriptionError(node.at, f"joint {name!r} has no <{tag} link=…>", "missing-link")
    dynamics = node.find("dynamics")
    if dynamics is not None and dynamics.attribute("damping") is None and dynamics.attribute("friction") is None:
        fault = f"joint {name!r}: <dynamics> with neither damping nor friction, for which urdfdom refuses the robot"
        report.warn(dynamics.at, f"{fault}; both are 0", "incomplete-element")
    joint = RobotJoint(
        name=name,
        type=cast(RobotJointType, type_),
        parent=links["parent"],
        child=links["child"],
        at=node.at,
        parent_from_joint=read_origin(node, report),
        axis=_read_axis(node, name, type_, report),
        limit=_read_limit(node, name, type_, report),
        damping=read_optional(dynamics, "damping", 0.0, report),
        friction=read_optional(dynamics, "friction", 0.0, report),
        mimic=_read_mimic(node, name, report),
        safety=_read_safety(node, name, report),
    )
    node.find("calibration")  # only real hardware uses it
    node.report_unread(report)
    return joint


def _read_axis(node: XmlNode, name: str, type_: str, report: Diagnostics) -> Vector3:
    axis = node.find("axis")
    if axis is None or type_ in ("fixed", "floating"):
        return (1.0, 0.0, 0.0)
    vector = read_vector(axis, "xyz", report)
    if vector is None:
        return (1.0, 0.0, 0.0)
    if not any(vector):
        report.warn(axis.at, f"joint {name!r}: an axis of zero length; 1 0 0 is used", "zero-vector")
        return (1.0, 0.0, 0.0)
    return vector


def _read_limit(node: XmlNode, name: str, type_: str, report: Diagnostics) -> JointLimit | None:
    limit = node.find("limit")
    if limit is None:
        if type_ in _LIMITED:
            raise DescriptionError(
                node.at, f"joint {name!r}: a {type_} joint needs <limit effort= velocity=>", "missing-limit"
            )
        return None
    for key in ("effort", "velocity"):
        if limit.attribute(key) is None:
            raise DescriptionError(limit.at, f"joint {name!r}: <limit> needs {key!r}", "missing-limit")
    return JointLimit(
        lower=read_optional(limit, "lower", 0.0, report),
        upper=read_optional(limit, "upper", 0.0, report),
        effort=read_optional(limit, "effort", 0.0, report),
        velocity=read_optional(limit, "velocity", 0.0, report),
    )


def _read_safety(node: XmlNode, name: str, report: Diagnostics) -> RobotSafety | None:
    """Return the limits that planners use; None without any, as k_velocity and k_position are real hardware's."""
    safety = node.find("safety_controller")
    if safety is None:
        return None
    if safety.attribute("k_velocity") is None:
        fault = f"joint {name!r}: <safety_controller> without k_velocity, for which urdfdom refuses the robot"
        report.warn(safety.at, f"{fault}; it is ignored", "incomplete-element")
        return None
    if safety.attribute("soft_lower_limit") is None and safety.attribute("soft_upper_limit") is None:
        return None
    return RobotSafety(
        soft_lower_limit=read_optional(safety, "soft_lower_limit", 0.0, report),
        soft_upper_limit=read_optional(safety, "soft_upper_limit", 0.0, report),
    )


def _read_mimic(node: XmlNode, name: str, report: Diagnostics) -> RobotMimic | None:
    mimic = node.find("mimic")
    if mimic is None:
        return None
    leader = mimic.attribute("joint")
    if not leader:
        raise DescriptionError(mimic.at, f"joint {name!r}: <mimic> names no joint", "incomplete-element")
    return RobotMimic(
        joint=leader,
        multiplier=read_optional(mimic, "multiplier", 1.0, report),
        offset=read_optional(mimic, "offset", 0.0, report),
    )
