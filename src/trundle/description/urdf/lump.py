"""Lumping of links at fixed joints, as in Gazebo's conversion."""

from collections.abc import Iterable
from dataclasses import dataclass, field

from trundle.model import Inertial
from trundle.robot import Robot, RobotInertial, RobotShape
from trundle.spatial import ZERO, Pose, Quaternion, conjugate
from trundle.xmlnode import XmlNode

from ..inertia_sum import rotate_inertia, sum_inertias

WORLD = "world"


@dataclass(slots=True)
class Lump:
    """Link and everything rigidly fixed to it."""

    name: str
    parts: list[tuple[str, Pose]] = field(default_factory=list[tuple[str, Pose]])
    """(link, lump_from_link), starting with the lump's own link."""


def lump_links(robot: Robot, kept: frozenset[str]) -> dict[str, Lump]:
    """Return every lump by the name of its first link.

    Args:
        robot: as written.
        kept: fixed joints that stay joints, by their <gazebo> blocks.
    """
    holder = {j.child: j for j in robot.joints if j.type == "fixed" and j.name not in kept and j.parent != WORLD}
    lumps: dict[str, Lump] = {}
    places: dict[str, tuple[str, Pose]] = {}
    """Link → lump name and lump_from_link."""
    for link in robot.links:
        chain, name = list[str](), link.name
        while name in holder and name not in places:
            chain.append(name)
            name = holder[name].parent
        name, pose = places.setdefault(name, (name, Pose()))
        for each in reversed(chain):
            pose = pose @ holder[each].parent_from_joint
            places[each] = (name, pose)
        lump = lumps.setdefault(name, Lump(name))
        part = (link.name, pose)
        if link.name == name:
            lump.parts.insert(0, part)
        else:
            lump.parts.append(part)
    return lumps


def follow_lumps(plugin: XmlNode, lumps: Iterable[Lump]) -> None:
    """Replace lumped links in a plugin's <bodyName> and <frameName> by their lump, with an offset.

    As sdformat's conversion does (ReduceSDFExtensionPluginFrameReplace), so that plugins find their link; other names,
    such as <robotBaseFrame>, which is a tf frame, stay.
    """
    places = {link: (lump.name, pose) for lump in lumps for link, pose in lump.parts[1:]}
    for tag in ("bodyName", "frameName"):
        found = plugin.find(tag)
        if found is None or found.text not in places:
            continue
        name, pose = places[found.text]
        if tag == "bodyName":
            offsets = [plugin.vector(offset, default=ZERO) for offset in ("xyzOffset", "rpyOffset")]
            moved = pose @ Pose.from_rpy(*offsets[0], *offsets[1])
            plugin.write("xyzOffset", " ".join(f"{value:.12g}" for value in moved.position))
            plugin.write("rpyOffset", " ".join(f"{value:.12g}" for value in moved.rpy))
        plugin.write(tag, name)


def shape_name(lump: str, link: str, kind: str, number: int, shape: RobotShape) -> str:
    """Return Gazebo's name of a shape: its own or its link's, prefixed by the lump's if it was lumped."""
    suffix = f"_{number}" if number else ""
    if link == lump:
        return f"{shape.name or link}_{kind}{suffix}"
    return f"{lump}_fixed_joint_lump__{shape.name or link}_{kind}{suffix}"


def lumped_inertial(parts: list[tuple[RobotInertial, Pose]], orientation: Quaternion) -> Inertial:
    """Return the combined mass properties of several bodies, by the parallel axis theorem.

    Args:
        parts: each with lump_from_link.
        orientation: of the result's axes, in the lump's frame.
    """
    coms = [(part, pose @ part.link_from_com) for part, pose in parts]
    bodies = [
        (part.mass, com.position, rotate_inertia((*part.moments, *part.products), com.quaternion)) for part, com in coms
    ]
    mass, center, tensor = sum_inertias(bodies)
    ixx, iyy, izz, ixy, ixz, iyz = rotate_inertia(tensor, conjugate(orientation))
    return Inertial(
        mass=mass, link_from_com=Pose(center, orientation), moments=(ixx, iyy, izz), products=(ixy, ixz, iyz)
    )
