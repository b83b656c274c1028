"""Three-quarter view of a scene: a camera that sees all of it, from the side lit by Gazebo's sun."""

import math

import numpy as np
from numpy.typing import NDArray

from trundle.sim.render import Intrinsics, Scene, corners_of
from trundle.spatial import Pose, pose_from_row

FIELD_OF_VIEW = 0.6
"""Horizontal field of view [rad]: a long lens, with little perspective."""
STUDIO_LIGHT, BACKDROP = (0.6, 0.6, 0.6, 1.0), (0.95, 0.95, 0.95, 1.0)
"""Background, RGBA, brighter than most worlds."""
_FROM = (math.radians(-38.0), math.radians(16.0))
"""Azimuth and elevation of the view [rad]."""
_MARGIN = 1.08


def scene_corners(scene: Scene, poses: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return (N, 3) corners of all shapes but planes, in the world [m]."""
    points = [
        (pose_from_row(poses[shape.body]) @ shape.body_from_shape).transform_point(corner)
        for shape in scene.shapes
        for corner in corners_of(shape.geometry)
    ]
    return np.array(points or [(-1.0, -1.0, 0.0), (1.0, 1.0, 1.0)])


def three_quarter_pose(cloud: NDArray[np.float64], lens: Intrinsics, turned_rad: float = 0.0) -> Pose:
    """Return the pose in the world of a camera whose view contains all points; `turned_rad` turns it about z."""
    middle = (cloud.min(axis=0) + cloud.max(axis=0)) / 2
    azimuth, elevation = _FROM[0] + turned_rad, _FROM[1]
    away = np.array(
        [math.cos(elevation) * math.cos(azimuth), math.cos(elevation) * math.sin(azimuth), math.sin(elevation)]
    )
    rotation = Pose.from_rpy(0.0, 0.0, 0.0, 0.0, elevation, azimuth + math.pi)
    in_view = np.array([rotation.inverse().transform_vector((x, y, z)) for x, y, z in (cloud - middle).tolist()])
    half_width = math.tan(lens.horizontal_fov_rad / 2)
    half_height = half_width * lens.height_px / lens.width_px
    needed = np.maximum(np.abs(in_view[:, 1]) / half_width, np.abs(in_view[:, 2]) / half_height) - in_view[:, 0]
    x, y, z = (middle + away * float(needed.max()) * _MARGIN).tolist()
    return Pose((x, y, z), rotation.quaternion)
