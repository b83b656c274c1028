"""Wheels that steer.

A cylinder touches a floor along a line, which has no stable turning: by rigid Coulomb friction two driven wheels that
should turn a robot by 5.0 rad turn it by 4.5. A wheel therefore rolls on a tread, the ellipsoid inscribed in its
cylinder, which touches in the middle of its width; the cylinder, a tenth of a millimetre smaller, keeps it upright.
"""

from dataclasses import replace

import mujoco

from trundle.model import Collision, Cylinder, JointType

from .tree import Hold, Place

TREAD = 1e-4
"""[m] How far the tread stands out of the cylinder."""
SMALLEST = 1e-3
"""[m] Radius under which a cylinder is left as it is."""


def is_wheel(hold: Hold, place: Place, collision: Collision) -> bool:
    """Whether a cylinder turns about its own axis."""
    geometry, joint = collision.geometry, hold.joint
    axis = {JointType.REVOLUTE: joint.axis, JointType.REVOLUTE2: joint.axis2}.get(joint.type)
    if axis is None:
        return False
    if not isinstance(geometry, Cylinder) or geometry.radius < SMALLEST:
        return False
    world_from_cylinder = place.at_zero @ collision.link_from_collision
    along = world_from_cylinder.inverse().direction(hold.direction(axis))
    x, y, _ = world_from_cylinder.inverse().point(hold.world_from_joint.position)
    return abs(along[2]) > 0.9999 and max(abs(x), abs(y)) < TREAD


def add_tread(body: mujoco.MjsBody, collision: Collision, cylinder: Cylinder, name: str) -> mujoco.MjsGeom:
    """Add the ellipsoid."""
    pose = collision.link_from_collision
    tread = body.add_geom(name=name, pos=pose.position, quat=pose.quaternion, group=3)
    tread.type = mujoco.mjtGeom.mjGEOM_ELLIPSOID
    tread.size = [cylinder.radius, cylinder.radius, max(cylinder.length / 2, TREAD)]
    return tread


def without_tread(collision: Collision, cylinder: Cylinder) -> Collision:
    """What is left for the cylinder itself."""
    return replace(collision, geometry=replace(cylinder, radius=cylinder.radius - TREAD))
