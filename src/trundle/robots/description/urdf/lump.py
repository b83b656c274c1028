"""Lumping of links at fixed joints, as in Gazebo's conversion."""

from collections.abc import Iterable
from dataclasses import dataclass, field

from trundle.base.xmlnode import XmlNode
from trundle.robots.model import Inertial
from trundle.robots.robot import Robot, RobotInertial, RobotJoint
from trundle.spatial import ZERO, Pose, Quaternion, conjugate

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

    The parts of a lump are in sdformat's order, by which their shapes are numbered: each link before those fixed to it,
    which are sorted by the names of their joints (urdfdom's initTree, sdformat's ReduceFixedJoints).

    Args:
        robot: as written.
        kept: fixed joints that stay joints, by their <gazebo> blocks.
    """
    holders = [j for j in robot.joints if j.type == "fixed" and j.name not in kept and j.parent != WORLD]
    held = {joint.child for joint in holders}
    fixed_to: dict[str, list[RobotJoint]] = {}
    for joint in sorted(holders, key=lambda joint: joint.name, reverse=True):
        fixed_to.setdefault(joint.parent, []).append(joint)
    lumps = {link.name: Lump(link.name) for link in robot.links if link.name not in held}
    for lump in lumps.values():
        pending = [(lump.name, Pose())]
        while pending:
            name, pose = pending.pop()
            lump.parts.append((name, pose))
            pending += [(joint.child, pose @ joint.parent_from_joint) for joint in fixed_to.get(name, [])]
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
