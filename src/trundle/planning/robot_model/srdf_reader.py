"""Reader of SRDF by srdfdom's rules; what names a link or joint is checked when the model is built."""

from collections.abc import Iterable
from typing import TypeVar, cast, get_args

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.base.xmlnode import MAX_NUMBER, XmlNode, is_within, parse_numbers, parse_xml

from .srdf import (
    DisabledPair,
    Srdf,
    SrdfChain,
    SrdfEndEffector,
    SrdfGroup,
    SrdfState,
    SrdfVirtualJoint,
    VirtualJointType,
)

_TYPES: tuple[str, ...] = get_args(VirtualJointType)
_Part = TypeVar("_Part")


def read_srdf(text: str | bytes, report: Diagnostics, *, name: str = "robot_description_semantic") -> Srdf:
    """Read an SRDF; an element without what it needs is left out with a warning.

    Args:
        text: the whole document, without xacro.
        report: collects findings.
        name: file or parameter in messages.

    Raises:
        DescriptionError: not XML, or the root is no <robot>.
    """
    root = parse_xml(text, name=name, report=report)
    if root.tag != "robot":
        raise DescriptionError(root.at, f"an SRDF starts with <robot>, not <{root.tag}>", "wrong-root")
    root.attribute("version")
    srdf = Srdf(
        name=root.attribute("name") or "",
        at=root.at,
        groups=_present(_group(node, report) for node in root.all("group")),
        states=_present(_state(node, report) for node in root.all("group_state")),
        end_effectors=_present(_end_effector(node, report) for node in root.all("end_effector")),
        virtual_joints=_present(_virtual_joint(node, report) for node in root.all("virtual_joint")),
        passive_joints=_present(_named(node, "name", report) for node in root.all("passive_joint")),
        disabled=_present(_disabled(node, report) for node in root.all("disable_collisions")),
        unchecked=_present(_named(node, "link", report) for node in root.all("disable_default_collisions")),
        enabled=_present(_pair(node, report) for node in root.all("enable_collisions")),
        joint_properties=_properties(root.all("joint_property"), report),
    )
    spheres = root.all("link_sphere_approximation")
    for node in spheres:
        node.mark_all_read()
    if spheres:
        reason = "<link_sphere_approximation>: collisions are checked with the links' own shapes, not with spheres"
        report.info(spheres[0].at, reason, "ignored-element")
    root.report_unread(report)
    return srdf


def _present(parts: Iterable[_Part | None]) -> tuple[_Part, ...]:
    return tuple(part for part in parts if part is not None)


def _values(node: XmlNode, report: Diagnostics, *names: str) -> list[str] | None:
    """Return required attributes, stripped; None with a warning if one is missing."""
    values = [(node.attribute(name) or "").strip() for name in names]
    missing = [name for name, value in zip(names, values, strict=True) if not value]
    if missing:
        needed = ", ".join(map(repr, missing))
        report.warn(node.at, f"<{node.tag}> needs the attribute {needed}; it is left out", "missing-attribute")
        return None
    return values


def _named(node: XmlNode, attribute: str, report: Diagnostics) -> str | None:
    values = _values(node, report, attribute)
    node.report_unread(report)
    return None if values is None else values[0]


def _group(node: XmlNode, report: Diagnostics) -> SrdfGroup | None:
    names = _values(node, report, "name")
    if names is None:
        return None
    chains: list[SrdfChain] = []
    for child in node.all("chain"):
        ends = _values(child, report, "base_link", "tip_link")
        child.report_unread(report)
        if ends is not None:
            chains.append(SrdfChain(base_link=ends[0], tip_link=ends[1]))
    group = SrdfGroup(
        name=names[0],
        at=node.at,
        joints=_present(_named(child, "name", report) for child in node.all("joint")),
        links=_present(_named(child, "name", report) for child in node.all("link")),
        chains=tuple(chains),
        subgroups=_present(_named(child, "name", report) for child in node.all("group")),
    )
    node.report_unread(report)
    return group


def _state(node: XmlNode, report: Diagnostics) -> SrdfState | None:
    names = _values(node, report, "name", "group")
    if names is None:
        return None
    positions: dict[str, tuple[float, ...]] = {}
    for child in node.all("joint"):
        joint = _values(child, report, "name", "value")
        child.report_unread(report)
        if joint is None:
            continue
        numbers = parse_numbers(joint[1])
        if not numbers or not is_within(numbers, MAX_NUMBER):
            fault = f"group_state {names[0]!r}: {joint[1]!r} of joint {joint[0]!r} is not one or more numbers"
            report.warn(child.at, f"{fault}; the joint is left out", "invalid-value")
            continue
        positions[joint[0]] = tuple(numbers)
    node.report_unread(report)
    return SrdfState(name=names[0], group=names[1], at=node.at, positions=positions)


def _end_effector(node: XmlNode, report: Diagnostics) -> SrdfEndEffector | None:
    values = _values(node, report, "name", "group", "parent_link")
    parent_group = (node.attribute("parent_group") or "").strip()
    node.report_unread(report)
    if values is None:
        return None
    name, group, parent_link = values
    return SrdfEndEffector(name=name, group=group, parent_link=parent_link, parent_group=parent_group, at=node.at)


def _virtual_joint(node: XmlNode, report: Diagnostics) -> SrdfVirtualJoint | None:
    values = _values(node, report, "name", "type", "parent_frame", "child_link")
    node.report_unread(report)
    if values is None:
        return None
    name, type_, parent_frame, child_link = values
    kind = type_.lower()
    if kind not in _TYPES:
        fault = f"virtual_joint {name!r}: no type {type_!r}; types: {', '.join(_TYPES)}"
        report.warn(node.at, f"{fault}; it is fixed, as in MoveIt", "unknown-choice")
        kind = "fixed"
    return SrdfVirtualJoint(
        name=name, type=cast(VirtualJointType, kind), parent_frame=parent_frame, child_link=child_link, at=node.at
    )


def _pair(node: XmlNode, report: Diagnostics) -> tuple[str, str] | None:
    values = _values(node, report, "link1", "link2")
    node.attribute("reason")
    node.report_unread(report)
    return None if values is None else (values[0], values[1])


def _disabled(node: XmlNode, report: Diagnostics) -> DisabledPair | None:
    reason = (node.attribute("reason") or "").strip()
    pair = _pair(node, report)
    return None if pair is None else DisabledPair(link1=pair[0], link2=pair[1], reason=reason, at=node.at)


def _properties(nodes: list[XmlNode], report: Diagnostics) -> dict[str, dict[str, str]]:
    properties: dict[str, dict[str, str]] = {}
    for node in nodes:
        values = _values(node, report, "joint_name", "property_name", "value")
        node.report_unread(report)
        if values is not None:
            properties.setdefault(values[0], {})[values[1]] = values[2]
    return properties
