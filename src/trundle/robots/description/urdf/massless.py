"""Massless links, which Gazebo's conversion drops together with their subtree.

A lumped massless link counts too: sdformat's traversal of the tree stops at it (parser_urdf.cc, CreateSDF), so an arm
on a mount without <inertial> is lost, although the mount's own shapes are part of its parent's body.
"""

from collections.abc import Mapping

from trundle.base.diagnostics import Diagnostics
from trundle.robots.robot import Robot, RobotLink

from .lump import WORLD, Lump

_NO_MASS = 1e-6
"""Mass that ignition::math::equal treats as zero [kg]."""


def massless_lumps(robot: Robot, lumps: Mapping[str, Lump], report: Diagnostics) -> set[str]:
    """Return the dropped lumps, with a warning for each massless link."""
    tree = _Tree(robot, lumps)
    dropped: set[str] = set()
    for link in robot.links:
        if link.name == WORLD or link.name in dropped or tree.mass[link.name] > _NO_MASS:
            continue
        newly_dropped = [name for name in tree.subtree(link.name) if name not in dropped]
        dropped.update(newly_dropped)
        if newly_dropped:
            report.warn(link.at, _sentence(link, tree.mass[link.name], newly_dropped), "massless-link")
    return dropped


def _sentence(link: RobotLink, mass: float, dropped: list[str]) -> str:
    subject = f"link {link.name!r}"
    if mass > 0.0:
        subject += f" weighs {mass:g} kg, which Gazebo rounds to zero: "
    elif mass < 0.0:
        subject += f" weighs {mass:g} kg; "
    else:
        subject += " has no mass; as in Gazebo "
    below = ", ".join(repr(name) for name in dropped if name != link.name)
    if dropped[0] == link.name:
        subtree = f" with {below} below it" if below else ""
        return f"{subject}it is left out of the simulation{subtree}; give it an <inertial>"
    return f"{subject}its subtree is left out of the simulation: {below}; give it an <inertial>"


class _Tree:
    """Children and lumped mass of each link."""

    def __init__(self, robot: Robot, lumps: Mapping[str, Lump]) -> None:
        self._lump_of = {link: lump.name for lump in lumps.values() for link, _ in lump.parts}
        self._children: dict[str, list[str]] = {}
        for joint in robot.joints:
            self._children.setdefault(joint.parent, []).append(joint.child)
        self.mass = {link.name: 0.0 if link.inertial is None else link.inertial.mass for link in robot.links}
        """Mass of each link and the links lumped into it [kg]."""
        order = [robot.root]
        for name in order:
            order += self._children.get(name, [])
        for name in reversed(order):
            self.mass[name] += sum(self.mass[child] for child in self._lumped(name))

    def _lumped(self, link: str) -> list[str]:
        lump = self._lump_of[link]
        return [child for child in self._children.get(link, []) if self._lump_of[child] == lump]

    def subtree(self, link: str) -> list[str]:
        """Return the lumps in a link's subtree, starting with the link if it is one."""
        pending, subtree_lumps = [link], list[str]()
        while pending:
            name = pending.pop(0)
            if self._lump_of[name] == name:
                subtree_lumps.append(name)
            pending += self._children.get(name, [])
        return subtree_lumps
