"""Camera of a picture."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from trundle.sim.render import Intrinsics
from trundle.spatial import Pose, Quaternion, Vector3, matrix_from_quaternion, quaternion_from_rpy

from .placer import Arrangement
from .plan import DatasetPlan, Orbit
from .random_stream import CAMERA, draw_numbers, random_stream

_HALF_TURN = math.pi / 2
CAMERA_FROM_OPTICAL = Pose(quaternion=quaternion_from_rpy(-_HALF_TURN, 0.0, -_HALF_TURN))
"""Optical frame (x right, y down, z ahead) in the camera frame (x ahead, y left, z up)."""


@dataclass(frozen=True)
class View:
    """Camera of a picture."""

    world_from_camera: Pose
    """x along the view, y to the left, z up."""
    lens: Intrinsics

    @cached_property
    def world_from_optical(self) -> Pose:
        """Pose of the optical frame."""
        return self.world_from_camera @ CAMERA_FROM_OPTICAL

    @cached_property
    def rotation(self) -> NDArray[np.float64]:
        """(3, 3) axes of the optical frame in the world, in columns."""
        return matrix_from_quaternion(self.world_from_optical.quaternion)

    def project(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return (N, 3) pixel coordinates and depths [px, px, m] of (N, 3) points in the world.

        Behind the camera the depth is negative and the pixel is meaningless.
        """
        local = (points - self.world_from_camera.position) @ self.rotation
        depth = local[:, 2]
        safe = np.where(np.abs(depth) < 1e-9, 1e-9, depth)
        f = self.lens.focal_px
        columns = self.lens.width_px / 2 + f * local[:, 0] / safe
        return np.array([columns, self.lens.height_px / 2 + f * local[:, 1] / safe, depth]).T


def draw_view(plan: DatasetPlan, number: int, arrangement: Arrangement) -> View:
    """Draw the camera of a picture."""
    random, camera = random_stream(plan.seed, number, CAMERA), plan.camera
    if isinstance(camera.viewpoint, Orbit):
        distance, azimuth, elevation = (
            quantity.draw(random)
            for quantity in (camera.viewpoint.distance, camera.viewpoint.azimuth, camera.viewpoint.elevation)
        )
        flat, (x, y, z) = distance * math.cos(elevation), camera.viewpoint.center
        eye = (x + flat * math.cos(azimuth), y + flat * math.sin(azimuth), z + distance * math.sin(elevation))
    else:
        assert not isinstance(camera.viewpoint, str), "a mounted camera has its own view"
        eye = draw_numbers(camera.viewpoint, random)
    target = _target(plan, arrangement, random)
    lens = Intrinsics(
        width_px=plan.width_px,
        height_px=plan.height_px,
        horizontal_fov_rad=camera.horizontal_fov.draw(random),
        near_m=camera.near_m,
        far_m=camera.far_m,
    )
    return View(Pose(eye, looking_rotation(eye, target, camera.roll.draw(random))), lens)


def _target(plan: DatasetPlan, arrangement: Arrangement, random: np.random.Generator) -> Vector3:
    look_at = plan.camera.look_at
    if isinstance(look_at, tuple):
        return draw_numbers(look_at, random)
    candidates = [
        instance
        for instance in arrangement.present
        if instance.plan is not None and look_at in (None, instance.plan.name)
    ]
    if not candidates:
        return plan.camera.viewpoint.center if isinstance(plan.camera.viewpoint, Orbit) else (0.0, 0.0, 0.0)
    if look_at is not None:
        return arrangement.world_from_models[candidates[int(random.integers(len(candidates)))].number].position
    x, y, z = np.mean(
        [arrangement.world_from_models[instance.number].position for instance in candidates], axis=0
    ).tolist()
    return x, y, z


def looking_rotation(eye: Vector3, target: Vector3, roll: float = 0.0) -> Quaternion:
    """Return the rotation of a camera that looks at a point; `roll` is about its view axis [rad]."""
    x, y, z = (t - e for t, e in zip(target, eye, strict=True))
    return quaternion_from_rpy(roll, -math.atan2(z, math.hypot(x, y)), math.atan2(y, x))
