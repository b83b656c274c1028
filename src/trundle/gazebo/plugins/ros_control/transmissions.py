"""Joints and interfaces of a robot's <transmission> tags."""

from dataclasses import dataclass
from typing import Literal, TypeAlias

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.base.xmlnode import XmlNode, parse_xml

Interface: TypeAlias = Literal["EffortJointInterface", "PositionJointInterface", "VelocityJointInterface"]
INTERFACES: tuple[Interface, ...] = ("EffortJointInterface", "PositionJointInterface", "VelocityJointInterface")
_PACKAGE = "hardware_interface/"


@dataclass(frozen=True, slots=True)
class DrivenJoint:
    """One joint of a transmission."""

    name: str
    interface: Interface


def read_transmissions(urdf: str, name: str, report: Diagnostics, *, drives_groups: bool = False) -> list[DrivenJoint]:
    """Read every joint that a transmission drives, in file order; warn of invalid ones and leave them out.

    Rules of transmission_interface's TransmissionParser and gazebo_ros_control's DefaultRobotHWSim; an interface in
    the <actuator> counts, too, as before Indigo.

    Args:
        urdf: robot as XML.
        name: name of the text in messages.
        report: receives warnings.
        drives_groups: True if each joint of a transmission of several, as of a differential, is driven by its own
            interface, as robots' own hardware does; the default hardware drops such transmissions.

    Raises:
        DescriptionError: the text is not a URDF.
    """
    root = parse_xml(urdf, name=name, report=report)
    if root.tag != "robot":
        raise DescriptionError(root.at, f"a URDF starts with <robot>, not <{root.tag}>", "wrong-root")
    joints: dict[str, DrivenJoint] = {}
    for transmission in root.all("transmission"):
        if why := _find_fault(transmission, drives_groups=drives_groups):
            name_attribute = transmission.attribute("name")
            subject = "a transmission" if not name_attribute else f"transmission {name_attribute!r}"
            report.warn(transmission.at, f"{subject} {why}; it is left out", "transmission")
            continue
        for joint in transmission.all("joint"):
            driven = _read_driven_joint(transmission, joint, report)
            if driven is None:
                continue
            if driven.name in joints:
                report.warn(
                    joint.at, f"joint {driven.name!r} has a transmission already; this one is left out", "transmission"
                )
                continue
            joints[driven.name] = driven
    return list(joints.values())


def _find_fault(transmission: XmlNode, *, drives_groups: bool) -> str | None:
    """Fault for which the original drops a transmission with all its joints; None if it is valid."""
    if not transmission.attribute("name"):
        return "has no name"
    if not transmission.string("type"):
        return "has no <type>"
    for tag in ("joint", "actuator"):
        names = [node.attribute("name") for node in transmission.all(tag)]
        if None in names:
            return f"has a <{tag}> without a name"
        if not any(names):
            return f"has no <{tag}>"
    joints = [joint for joint in transmission.all("joint") if joint.attribute("name")]
    count = sum(1 for joint in joints if _interfaces(joint)) or len(joints)
    if count > 1 and not drives_groups:
        return f"has {count} joints, but gazebo_ros_control drives one joint per transmission"
    return None


def _read_driven_joint(transmission: XmlNode, joint: XmlNode, report: Diagnostics) -> DrivenJoint | None:
    name = joint.attribute("name")
    subject = f"transmission {transmission.attribute('name')!r} of joint {name!r}"
    if not name:
        report.warn(joint.at, f"{subject}: the name is empty; it is left out", "transmission")
        return None
    texts = _interfaces(joint) or [text for actuator in transmission.all("actuator") for text in _interfaces(actuator)]
    if not texts:
        report.warn(joint.at, f"{subject} has no <hardwareInterface>; it is left out", "transmission")
        return None
    if len(_interfaces(joint)) > 1:
        report.warn(
            joint.at, f"{subject} has {len(texts)} <hardwareInterface> elements; the first one is used", "transmission"
        )
    interface = texts[0].removeprefix(_PACKAGE)
    if interface not in INTERFACES:
        problem = f"{subject}: unknown hardware interface {texts[0]!r}; known: {', '.join(INTERFACES)}; it is left out"
        report.warn(joint.at, problem, "transmission")
        return None
    return DrivenJoint(name, interface)


def _interfaces(node: XmlNode) -> list[str]:
    return [interface.text for interface in node.all("hardwareInterface") if interface.text]
