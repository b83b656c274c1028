"""Reader of <joint>: SDF 1.0 to 1.4 give axes in the model frame, later versions in the joint's or a named frame."""

import math
from collections.abc import Callable
from typing import TypeAlias

from trundle.base.xmlnode import MAX_NUMBER, XmlNode, parse_numbers
from trundle.robots.model import UNLIMITED, Joint, JointAxis, JointType, Mimic
from trundle.spatial import Pose, Vector3, normalized

from .context import Context
from .frames import FrameGraph
from .sensor import read_sensor

_WITHOUT_AXIS = frozenset({JointType.FIXED, JointType.BALL})
_TWO_AXES = frozenset({JointType.UNIVERSAL, JointType.REVOLUTE2, JointType.GEARBOX})
TYPES = {"continuous": JointType.REVOLUTE} | {kind.value: kind for kind in JointType if kind is not JointType.PLANAR}
"""Name in the file → type."""
FrameOf: TypeAlias = Callable[[str], Pose | None]
"""Function that returns model_from_frame of a frame's name; "" is the joint frame."""


def read_joint(
    node: XmlNode,
    *,
    parent: str,
    child: str,
    child_from_joint: Pose,
    frame: FrameOf,
    graph: FrameGraph,
    context: Context,
) -> Joint:
    """Read a joint whose links and pose are resolved.

    Args:
        node: <joint>.
        parent: link, or "world".
        child: link.
        child_from_joint: pose of the joint frame.
        frame: resolves `expressed_in`.
        graph: resolves the poses of its sensors.
        context: context of the file.
    """
    report = context.report
    name = node.required_attribute("name")
    type_ = TYPES[node.required_attribute("type")]
    axis, axis2 = node.find("axis"), node.find("axis2")
    joint = Joint(
        name=name,
        type=type_,
        parent=parent,
        child=child,
        at=node.at,
        child_from_joint=child_from_joint,
        axis=None if type_ in _WITHOUT_AXIS else _read_axis(axis, node, frame, graph.root, context),
        axis2=_read_axis(axis2, node, frame, graph.root, context) if type_ in _TWO_AXES else None,
        thread_pitch=_thread_pitch(node),
        gearbox_ratio=node.number("gearbox_ratio", default=1.0),
        gearbox_reference_body=node.string("gearbox_reference_body") or None,
        sensors=tuple(read_sensor(child, name, graph, context) for child in node.all("sensor")),
    )
    physics = node.find("physics")
    if physics is not None and [child.tag for child in physics.children] != ["provide_feedback"]:
        report.info(physics.at, f"joint {name!r}: <physics> tunes Gazebo's engines; it is ignored", "engine-tuning")
    node.report_unread(report)
    return joint


def _thread_pitch(node: XmlNode) -> float:
    """Return the thread pitch in Gazebo's convention [rad/m]; SDF 1.10 added a right-hand thread in metres per turn."""
    per_turn = node.number("screw_thread_pitch", default=0.0)
    if per_turn:
        node.find("thread_pitch")
        return -math.tau / per_turn
    return node.number("thread_pitch", default=1.0)


def _read_axis(node: XmlNode | None, joint: XmlNode, frame: FrameOf, root: str, context: Context) -> JointAxis:
    report, name = context.report, joint.required_attribute("name")
    if node is None:
        report.warn(joint.at, f"joint {name!r} has no <axis>; 0 0 1 is used, without limits", "missing-axis")
        return JointAxis(direction=_in_model("", (0.0, 0.0, 1.0), frame))
    unit = _unit(node, name, context)
    direction = _in_model(_expressed_in(node, name, frame, root, context), unit, frame)
    limit, dynamics = node.find("limit"), node.find("dynamics")

    def number(parent: XmlNode | None, tag: str, default: float) -> float:
        return default if parent is None else _number(parent, tag, default)

    def dynamic(tag: str) -> float:
        return 0.0 if dynamics is None else dynamics.number(tag, default=0.0)

    axis = JointAxis(
        direction=direction,
        lower=_limit(number(limit, "lower", -UNLIMITED)),
        upper=_limit(number(limit, "upper", UNLIMITED)),
        effort=_positive(number(limit, "effort", -1.0)),
        velocity=_positive(number(limit, "velocity", -1.0)),
        damping=dynamic("damping"),
        friction=dynamic("friction"),
        spring_reference=dynamic("spring_reference"),
        spring_stiffness=dynamic("spring_stiffness"),
        stop_stiffness=number(limit, "stiffness", 1e8),
        stop_dissipation=number(limit, "dissipation", 1.0),
        initial_position=node.number("initial_position", default=0.0),
        mimic=_mimic(node, context),
    )
    if axis.initial_position:
        report.info(
            node.at, f"joint {name!r} starts at its <initial_position>, which Gazebo ignores", "initial-position"
        )
    for element in (node, limit, dynamics):
        if element is not None:
            element.report_unread(report)
    return axis


def _mimic(axis: XmlNode, context: Context) -> Mimic | None:
    node = axis.find("mimic")
    if node is None:
        return None
    report = context.report
    mimic = Mimic(
        joint=node.required_attribute("joint"),
        axis=1 if node.attribute("axis") == "axis2" else 0,
        multiplier=node.number("multiplier", default=1.0),
        offset=node.number("offset", default=0.0),
        reference=node.number("reference", default=0.0),
    )
    node.report_unread(report)
    return mimic


def _unit(node: XmlNode, name: str, context: Context) -> Vector3:
    """Return the axis direction as written, normalised."""
    unit = normalized(node.vector("xyz", default=(0.0, 0.0, 1.0)))
    if unit is None:
        context.report.warn(node.at, f"joint {name!r}: an axis of zero length; 0 0 1 is used", "zero-vector")
    return unit or (0.0, 0.0, 1.0)


def _expressed_in(node: XmlNode, name: str, frame: FrameOf, root: str, context: Context) -> str:
    """Return the frame in which an axis is given; "" is the joint frame.

    Gazebo 11 converts every version to 1.7: 1.4's rule and a true <use_parent_model_frame> become
    expressed_in="__model__"; otherwise `expressed_in` has its meaning in every version.
    """
    report = context.report
    xyz = node.find("xyz")
    written = (None if xyz is None else xyz.attribute("expressed_in")) or ""
    if context.version < (1, 7):
        if context.version < (1, 5):
            report.info(
                node.at, f"SDF {context.version}: the axis of joint {name!r} is read in the model frame", "axis-frame"
            )
        if node.flag("use_parent_model_frame", default=context.version < (1, 5)):
            if written not in ("", root):
                report.warn(
                    node.at, f"joint {name!r}: its axis is read in the model frame, not in {written!r}", "axis-frame"
                )
            return root
    if frame(written) is None:
        report.warn(
            node.at, f"joint {name!r}: no frame {written!r}; its axis is read in the joint's own frame", "missing-frame"
        )
        return ""
    return written


def _in_model(expressed_in: str, direction: Vector3, frame: FrameOf) -> Vector3:
    pose = frame(expressed_in)
    assert pose is not None
    return pose.transform_vector(direction)


def _number(node: XmlNode, tag: str, default: float) -> float:
    """Return a number that may be infinite, as limits are in SDF 1.10 and later."""
    child = node.find(tag)
    if child is not None and child.text.lower() in ("inf", "+inf", "-inf", "infinity", "-infinity"):
        return float(child.text)
    values = None if child is None else parse_numbers(child.text)
    if values is not None and len(values) == 1 and abs(values[0]) > MAX_NUMBER:  # sdformat writes infinity as 1.8e308
        return math.copysign(math.inf, values[0])
    return node.number(tag, default=default)


def _limit(value: float) -> float:
    return value if abs(value) < UNLIMITED else math.copysign(math.inf, value)


def _positive(value: float) -> float:
    """Return infinity for negative values (−1 is SDF's unlimited)."""
    return math.inf if value < 0 or value >= UNLIMITED else value
