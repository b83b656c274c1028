"""Wheels as treads: pure geometry, so `check` can report them without the engine.

A cylinder touches a floor along a line, whose rotation has no stable solution: with rigid Coulomb friction two driven
wheels that should turn a robot by 5.0 rad turn it by 4.5. A wheel therefore rolls on a tread, the ellipsoid inscribed
in its cylinder, which touches in the middle of its width; the cylinder, 0.1 mm smaller, keeps it upright.
"""

from msgspec.structs import replace

from trundle.base.diagnostics import Diagnostics
from trundle.robots.model import Collision, Cylinder, Ellipsoid, JointType, World

from .kinematic_tree import JointEdge, KinematicTree, LinkNode

TREAD = 1e-4
"""Difference of radius between tread and cylinder [m]."""
TREAD_POINTS = 2
"""ODE contact points of a cylinder: its two edges."""
EDGE_POINTS = 0.01
"""Part of an ODE contact point represented by each edge of the cylinder, if the tread has sunk in."""
_SMALLEST = 1e-3
"""Smallest radius of a wheel [m]."""


def tread_of(collision: Collision, node: LinkNode, tree: KinematicTree) -> Ellipsoid | None:
    """Return the tread of a cylinder that spins about its axis of symmetry; None for other shapes."""
    geometry, edge = collision.geometry, tree.parent_joint.get(node.name)
    if edge is None or not isinstance(geometry, Cylinder) or geometry.radius < _SMALLEST:
        return None
    if not _spins_about_cylinder_axis(edge, node, collision):
        return None
    return Ellipsoid((geometry.radius, geometry.radius, max(geometry.length / 2, TREAD)))


def _spins_about_cylinder_axis(edge: JointEdge, node: LinkNode, collision: Collision) -> bool:
    joint = edge.joint
    axis = {JointType.REVOLUTE: joint.axis, JointType.REVOLUTE2: joint.axis2}.get(joint.type)
    if axis is None:
        return False
    world_from_cylinder = node.world_from_link_at_zero @ collision.link_from_collision
    along = world_from_cylinder.inverse().transform_vector(edge.direction(axis))
    x, y, _ = world_from_cylinder.inverse().transform_point(edge.world_from_joint.position)
    return abs(along[2]) > 0.9999 and max(abs(x), abs(y)) < TREAD


def without_tread(collision: Collision) -> Collision:
    """Return the wheel's cylinder, reduced by the tread."""
    assert isinstance(collision.geometry, Cylinder)
    return replace(collision, geometry=replace(collision.geometry, radius=collision.geometry.radius - TREAD))


def report_wheels(world: World, report: Diagnostics) -> None:
    """Report every wheel and the deviation of its tread from the cylinder in the file.

    Args:
        world: without nested models.
        report: receives a note per wheel.

    Raises:
        DescriptionError: two models, or two links or joints of one, share a name.
    """
    tree = KinematicTree.from_world(world, Diagnostics())
    for node in tree.links.values():
        for collision in node.link.collisions:
            if tread_of(collision, node, tree) is not None:
                note = "a wheel; in physics it rolls on the ellipsoid inscribed in it"
                away = f"a surface up to {TREAD * 1e3:g} mm away"
                report.info(collision.at, f"collision {collision.name!r}: {note}, {away}", "approximated-shape")
