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
    """Link and all links rigidly fixed to it."""

    name: str
    parts: list[tuple[str, Pose]] = field(default_factory=list[tuple[str, Pose]])
    """(link, lump_from_link), starting with the lump's own link."""


def lump_links(robot: Robot, preserved: frozenset[str]) -> dict[str, Lump]:
    """Return every lump by the name of its first link.

    The parts of a lump are in sdformat's order, by which their shapes are numbered: each link before those fixed to it,
    which are sorted by the names of their joints (urdfdom's initTree, sdformat's ReduceFixedJoints).

    Args:
        robot: URDF tree.
        preserved: fixed joints that their <gazebo> blocks preserve.
    """
    lumped_joints = [j for j in robot.joints if j.type == "fixed" and j.name not in preserved and j.parent != WORLD]
    lumped = {joint.child for joint in lumped_joints}
    fixed_to: dict[str, list[RobotJoint]] = {}
    for joint in sorted(lumped_joints, key=lambda joint: joint.name, reverse=True):
        fixed_to.setdefault(joint.parent, []).append(joint)
    lumps = {link.name: Lump(link.name) for link in robot.links if link.name not in lumped}
    for lump in lumps.values():
        pending = [(lump.name, Pose())]
        while pending:
            name, pose = pending.pop()
            lump.parts.append((name, pose))
            pending += [(joint.child, pose @ joint.parent_from_joint) for joint in fixed_to.get(name, [])]
    return lumps


def follow_lumps(plugin: XmlNode, lumps: Iterable[Lump]) -> None:
    """Replace lumped links in a plugin's <bodyName> and <frameName> by their lump, with an offset.

    sdformat's conversion does the same (ReduceSDFExtensionPluginFrameReplace); other names stay, such as
    <robotBaseFrame>, which is a tf frame.
    """
    lump_from_link = {link: (lump.name, pose) for lump in lumps for link, pose in lump.parts[1:]}
    for tag in ("bodyName", "frameName"):
        element = plugin.find(tag)
        if element is None or element.text not in lump_from_link:
            continue
        name, pose = lump_from_link[element.text]
        if tag == "bodyName":
            offsets = [plugin.vector(offset, default=ZERO) for offset in ("xyzOffset", "rpyOffset")]
            moved = pose @ Pose.from_rpy(*offsets[0], *offsets[1])
            plugin.write("xyzOffset", " ".join(f"{value:.12g}" for value in moved.position))
            plugin.write("rpyOffset", " ".join(f"{value:.12g}" for value in moved.rpy))
        plugin.write(tag, name)


def lumped_inertial(parts: list[tuple[RobotInertial, Pose]], orientation: Quaternion) -> Inertial:
    """Return the combined mass properties of several bodies, by the parallel axis theorem.

    Args:
        parts: (inertial, lump_from_link) of each body.
        orientation: axes of the result in the lump's frame.
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
