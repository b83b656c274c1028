"""Links joined by fixed joints become one, as Gazebo's conversion makes them."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from trundle.model import Inertial
from trundle.robot import Robot, RobotInertial, RobotShape
from trundle.spatial import Pose, Quaternion, Vector3, rotate

WORLD = "world"


@dataclass(slots=True)
class Lump:
    """A link and everything rigidly fixed to it."""

    name: str
    parts: list[tuple[str, Pose]] = field(default_factory=list[tuple[str, Pose]])
    """(link, lump_from_link), the lump's own link first."""


def lump_links(robot: Robot, kept: frozenset[str]) -> dict[str, Lump]:
    """Every lump by the name of its first link.

    Args:
        robot: as written.
        kept: fixed joints that stay joints, as their <gazebo> blocks ask.
    """
    holder = {j.child: j for j in robot.joints if j.type == "fixed" and j.name not in kept and j.parent != WORLD}
    lumps: dict[str, Lump] = {}
    places: dict[str, tuple[str, Pose]] = {}
    """Link → its lump and lump_from_link."""
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


def shape_name(lump: str, link: str, kind: str, number: int, shape: RobotShape) -> str:
    """The name Gazebo gives a shape: its own or its link's, with the lump's in front where it was lumped."""
    suffix = f"_{number}" if number else ""
    if link == lump:
        return f"{shape.name or link}_{kind}{suffix}"
    return f"{lump}_fixed_joint_lump__{shape.name or link}_{kind}{suffix}"


def lumped_inertial(parts: list[tuple[RobotInertial, Pose]], orientation: Quaternion) -> Inertial:
    """The mass properties of several bodies as one, by the parallel axis theorem.

    Args:
        parts: each with lump_from_link.
        orientation: of the axes to express it in, seen from the lump's frame.
    """
    mass = sum(part.mass for part, _ in parts)
    coms = [(pose @ part.link_from_com) for part, pose in parts]
    center = np.average([com.position for com in coms], axis=0, weights=[part.mass for part, _ in parts])
    total = np.zeros((3, 3))
    for (part, _), com in zip(parts, coms, strict=True):
        rotation = _matrix(com)
        arm = np.array(com.position) - center
        total += rotation @ _tensor(part) @ rotation.T
        total += part.mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    axes = _matrix(Pose(quaternion=orientation))
    total = axes.T @ total @ axes
    x, y, z = (float(c) for c in center)
    return Inertial(
        mass=mass,
        link_from_com=Pose((x, y, z), orientation),
        moments=_three(total[0, 0], total[1, 1], total[2, 2]),
        products=_three(total[0, 1], total[0, 2], total[1, 2]),
    )


def _three(x: float, y: float, z: float) -> Vector3:
    return (float(x), float(y), float(z))


def _matrix(pose: Pose) -> NDArray[np.float64]:
    axes = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    return np.array([rotate(pose.quaternion, axis) for axis in axes]).T


def _tensor(part: RobotInertial) -> NDArray[np.float64]:
    (ixx, iyy, izz), (ixy, ixz, iyz) = part.moments, part.products
    return np.array([[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]])
