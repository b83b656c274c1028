"""Which joints a robot's <transmission> tags drive, and through which interface."""

from dataclasses import dataclass
from typing import Literal, TypeAlias

from trundle.diagnostics import DescriptionError, Diagnostics
from trundle.xmlnode import XmlNode, parse_xml

Interface: TypeAlias = Literal["EffortJointInterface", "PositionJointInterface", "VelocityJointInterface"]
INTERFACES: tuple[Interface, ...] = ("EffortJointInterface", "PositionJointInterface", "VelocityJointInterface")
_PACKAGE = "hardware_interface/"


@dataclass(frozen=True, slots=True)
class DrivenJoint:
    """One joint of a transmission."""

    name: str
    interface: Interface


def read_transmissions(urdf: str, name: str, report: Diagnostics) -> list[DrivenJoint]:
    """Every joint that a simple transmission drives, in file order; what cannot be used is named.

    Args:
        urdf: the robot as XML.
        name: what messages call the text.
        report: takes what is left out.

    Raises:
        DescriptionError: the text is no robot.
    """
    root = parse_xml(urdf, name=name)
    if root.tag != "robot":
        raise DescriptionError(root.at, f"a URDF starts with <robot>, not <{root.tag}>")
    found: dict[str, DrivenJoint] = {}
    for transmission in root.all("transmission"):
        for joint in transmission.all("joint"):
            driven = _driven(transmission, joint, report)
            if driven is None:
                continue
            if driven.name in found:
                report.warn(joint.at, f"joint {driven.name!r} has a transmission already; this one is left out")
                continue
            found[driven.name] = driven
    return list(found.values())


def _driven(transmission: XmlNode, joint: XmlNode, report: Diagnostics) -> DrivenJoint | None:
    name = joint.attribute("name") or ""
    who = f"transmission {transmission.attribute('name')!r} of joint {name!r}"
    texts = [node.text.strip() for node in joint.all("hardwareInterface")]
    for actuator in transmission.all("actuator"):  # where old files have it
        texts += [node.text.strip() for node in actuator.all("hardwareInterface")]
    if transmission.find("type") is None:
        report.warn(transmission.at, f"{who} has no <type>; it is left out")
        return None
    if not texts:
        report.warn(transmission.at, f"{who} names no <hardwareInterface>; it is left out")
        return None
    interface = texts[0].removeprefix(_PACKAGE)
    if interface not in INTERFACES:
        what = f"{who}: no hardware interface {texts[0]!r}; there are {', '.join(INTERFACES)}; it is left out"
        report.warn(transmission.at, what)
        return None
    return DrivenJoint(name, interface)
