"""Preview of a URDF that cannot be simulated, such as one whose links have no mass."""

import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray

from trundle.base.diagnostics import Diagnostics
from trundle.robots.packages import Packages
from trundle.robots.robot import Robot, root_from_links
from trundle.sim.render import Scene
from trundle.spatial import rows_from_poses

from .lowest_point import lowest_point


def add_robot(scene: Scene, robot: Robot, packages: Packages, report: Diagnostics) -> tuple[Scene, NDArray[np.float64]]:
    """Add a robot to a scene, on the ground, its joints at zero.

    Returns:
        the scene with the robot's links as further bodies; their (links, 7) poses in the world.
    """
    from .robot_scene import robot_scene  # slow to load; other pictures do not need it

    drawn = robot_scene(robot, packages, report)
    poses = root_from_links(robot, {})
    links = [poses[name] for name in drawn.bodies]
    heights = [lowest_point(shape.geometry, links[shape.body] @ shape.body_from_shape) for shape in drawn.shapes]
    rows = rows_from_poses(links)
    rows[:, 2] -= min(heights, default=0.0)
    first = len(scene.bodies)
    moved = tuple(replace(shape, body=shape.body + first) for shape in drawn.shapes)
    return replace(scene, bodies=(*scene.bodies, *drawn.bodies), shapes=(*scene.shapes, *moved)), rows
