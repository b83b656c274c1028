"""Reads <joint>: SDF 1.0 to 1.4 write axes in the model frame, 1.5 and 1.6 in the joint's unless told otherwise,
1.7 and later in whichever frame `expressed_in` names.
"""

import math
from collections.abc import Callable

from trundle.diagnostics import DescriptionError
from trundle.model import UNLIMITED, Joint, JointAxis, JointType
from trundle.spatial import Pose, Vector3, normalized
from trundle.xmlnode import XmlNode

from .context import Context

_WITHOUT_AXIS = frozenset({JointType.FIXED, JointType.BALL})
_TWO_AXES = frozenset({JointType.UNIVERSAL, JointType.REVOLUTE2, JointType.GEARBOX})


def read_joint(
    node: XmlNode,
    *,
    parent: str,
    child: str,
    child_from_joint: Pose,
    frame: Callable[[str, XmlNode], Pose],
    context: Context,
) -> Joint:
    """Read one joint whose links and pose have been found.

    Args:
        node: the element.
        parent: link, or "world".
        child: link.
        child_from_joint: the joint's frame.
        frame: model_from_frame by name, for `expressed_in`; "" is the joint's own frame.
        context: the file.

    Raises:
        DescriptionError: no type, or one that no SDF has.
    """
    name = node.required_attribute("name")
    type_ = _read_type(node, name)
    axis, axis2 = node.find("axis"), node.find("axis2")
    joint = Joint(
        name=name,
        type=type_,
        parent=parent,
        child=child,
        at=node.at,
        child_from_joint=child_from_joint,
        axis=None if type_ in _WITHOUT_AXIS else _read_axis(axis, node, name, frame, context),
        axis2=_read_axis(axis2, node, name, frame, context) if type_ in _TWO_AXES else None,
        thread_pitch=node.number("thread_pitch", default=1.0, report=context.report),
    )
    physics = node.find("physics")
    if physics is not None:
        context.report.warn(physics.at, f"joint {name!r}: <physics> is ODE's tuning; it is ignored")
    node.report_unread(context.report)
    return joint


def _read_type(node: XmlNode, name: str) -> JointType:
    text = node.required_attribute("type")
    if text == "continuous":
        return JointType.REVOLUTE
    try:
        return JointType(text)
    except ValueError:
        known = ", ".join(t.value for t in JointType)
        raise DescriptionError(node.at, f"joint {name!r}: no type {text!r}; types: continuous, {known}") from None


def _read_axis(
    node: XmlNode | None, joint: XmlNode, name: str, frame: Callable[[str, XmlNode], Pose], context: Context
) -> JointAxis:
    report = context.report
    if node is None:
        report.warn(joint.at, f"joint {name!r} has no <axis>; 0 0 1 is used, without limits")
        return JointAxis(direction=frame("", joint).direction((0.0, 0.0, 1.0)))
    direction = _direction(node, name, frame, context)
    limit, dynamics = node.find("limit"), node.find("dynamics")

    def of(parent: XmlNode | None, tag: str, default: float) -> float:
        return default if parent is None else _number(parent, tag, default, context)

    axis = JointAxis(
        direction=direction,
        lower=_limit(of(limit, "lower", -UNLIMITED)),
        upper=_limit(of(limit, "upper", UNLIMITED)),
        effort=_positive(of(limit, "effort", -1.0)),
        velocity=_positive(of(limit, "velocity", -1.0)),
        damping=of(dynamics, "damping", 0.0),
        friction=of(dynamics, "friction", 0.0),
        spring_reference=of(dynamics, "spring_reference", 0.0),
        spring_stiffness=of(dynamics, "spring_stiffness", 0.0),
    )
    if axis.lower > axis.upper:
        report.warn(node.at, f"joint {name!r}: lower {axis.lower:g} is above upper {axis.upper:g}; they are swapped")
        axis = JointAxis(
            direction=direction,
            lower=axis.upper,
            upper=axis.lower,
            effort=axis.effort,
            velocity=axis.velocity,
            damping=axis.damping,
            friction=axis.friction,
            spring_reference=axis.spring_reference,
            spring_stiffness=axis.spring_stiffness,
        )
    if limit is not None:
        for tag in ("stiffness", "dissipation"):
            limit.find(tag)
        limit.report_unread(report)
    if dynamics is not None:
        dynamics.report_unread(report)
    node.report_unread(report)
    return axis


def _direction(node: XmlNode, name: str, frame: Callable[[str, XmlNode], Pose], context: Context) -> Vector3:
    """The axis in the model frame, unit."""
    xyz = node.find("xyz")
    written = node.vector("xyz", default=(0.0, 0.0, 1.0), report=context.report)
    unit = normalized(written)
    if unit is None:
        context.report.warn(node.at, f"joint {name!r}: an axis of no length; 0 0 1 is used")
        unit = (0.0, 0.0, 1.0)
    in_model = node.flag("use_parent_model_frame", default=False, report=context.report)
    if context.version < (1, 5):
        context.report.info(node.at, f"SDF {context.version}: the axis of joint {name!r} is read in the model frame")
        return unit
    if context.version < (1, 7):
        return unit if in_model else frame("", node).direction(unit)
    expressed_in = (None if xyz is None else xyz.attribute("expressed_in")) or ""
    return frame(expressed_in, node).direction(unit)


def _number(node: XmlNode, tag: str, default: float, context: Context) -> float:
    """A number that may be infinite: SDF 1.10 and later write limits so."""
    child = node.find(tag)
    if child is not None and child.text.lower() in ("inf", "+inf", "-inf", "infinity", "-infinity"):
        return float(child.text)
    return node.number(tag, default=default, report=context.report)


def _limit(value: float) -> float:
    return value if abs(value) < UNLIMITED else math.copysign(math.inf, value)


def _positive(value: float) -> float:
    """−1 stands for none."""
    return math.inf if value < 0 or value >= UNLIMITED else value
