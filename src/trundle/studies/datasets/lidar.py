"""Lidar clouds with the instance at each point."""

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.sim.render import NativeRenderer, Scene
from trundle.spatial import Pose

from .plan import LidarPlan

_LUMINANCE = (0.2126, 0.7152, 0.0722)


class Cloud(Struct, frozen=True, eq=False):
    """Points of one scan."""

    points: NDArray[np.float32]
    """(N, 4) x, y, z in the lidar's frame [m], reflectance 0 to 1."""
    instances: NDArray[np.uint16]
    """(N,) number of the instance hit; 0: the rest of the world."""
    classes: NDArray[np.uint16]
    """(N,) number of the instance's category, from 1 on; 0: the rest of the world."""


class Lidar:
    """Lidar that moves with the camera and scans the same scene."""

    def __init__(self, plan: LidarPlan, numbers: NDArray[np.uint16], classes: NDArray[np.uint16]) -> None:
        """Compute the rays.

        Args:
            plan: lidar's plan.
            numbers: shape → number of its instance; the last entry is for no shape.
            classes: instance → number of its category.
        """
        x, y, z, roll, pitch, yaw = plan.camera_from_lidar
        self.pose = Pose.from_rpy(x, y, z, roll, pitch, yaw)
        """Pose in the camera's frame: x along the view."""
        self._range_m = plan.range_m
        self._numbers, self._classes = numbers, classes
        columns = np.linspace(*plan.horizontal, plan.columns, endpoint=False)
        yaws, pitches = np.meshgrid(columns, np.linspace(*plan.vertical, plan.beams))
        flat = np.cos(pitches)
        self._directions = np.stack([flat * np.cos(yaws), flat * np.sin(yaws), np.sin(pitches)], axis=-1).reshape(-1, 3)

    def scan(self, world_from_camera: Pose, renderer: NativeRenderer, scene: Scene) -> Cloud:
        """Scan the renderer's scene from the lidar's pose on a camera."""
        ranges, shapes = renderer.cast(world_from_camera @ self.pose, self._directions, max_range_m=self._range_m)
        hit = np.isfinite(ranges)
        points = self._directions[hit] * ranges[hit, None]
        reflectance = np.array([_reflectance(scene, i) for i in range(len(scene.shapes))])[shapes[hit]]
        cloud = np.concatenate([points, reflectance[:, None]], axis=1).astype(np.float32)
        instances = self._numbers[shapes[hit]]
        return Cloud(cloud, instances, self._classes[instances])


def _reflectance(scene: Scene, number: int) -> float:
    """Return the shape's <laser_retro>, or the luminance of its color if it has none."""
    shape = scene.shapes[number]
    retro = shape.laser_retro or float(np.dot(shape.rgba[:3], _LUMINANCE))
    return min(max(retro, 0.0), 1.0)
