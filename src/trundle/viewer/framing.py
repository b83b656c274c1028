"""Where the camera stands at first: far enough to see the robot whole, from its front and a little above."""

import math
from dataclasses import dataclass

import numpy as np
import viser
from numpy.typing import NDArray

from trundle.meshes import Mesh
from trundle.model import Box, Capsule, Cylinder, Ellipsoid, Plane, Sphere
from trundle.render import Shape
from trundle.spatial import compose_rows, finite_rows, rows_from_poses

from .content import ViewerScene

_HUGE_M = 20.0
"""What is larger (halls, terrain) is scenery: the camera stands within it."""
_GUESS_M = 1.0
_FOV_RAD = math.radians(50.0)
_FROM_FRONT = np.array([1.0, -0.95, 0.62]) / np.linalg.norm([1.0, -0.95, 0.62])
_FROM_ABOVE = np.array([-0.02, 0.0, 1.0])


@dataclass(frozen=True, slots=True, eq=False)
class Extent:
    """A ball around what matters in the scene, in the frame that the poses were given in."""

    center: NDArray[np.float64]
    """(3,) [m]"""
    radius: float
    """[m]"""
    is_guess: bool = False
    """Nothing was there to measure yet."""

    def aim(self, camera: "viser.InitialCameraConfig | viser.CameraHandle", *, from_above: bool = False) -> None:
        """Place a camera so that the ball fills most of the picture."""
        direction = _FROM_ABOVE if from_above else _FROM_FRONT
        if isinstance(camera, viser.CameraHandle):
            camera.up_direction = (0.0, 0.0, 1.0)
        else:
            camera.up = (0.0, 0.0, 1.0)
        camera.fov = _FOV_RAD
        camera.near = min(0.05, self.radius / 20)
        camera.position = self.center + direction * self.radius * (3.2 if from_above else 2.5)
        camera.look_at = self.center


def extent_of(scene: ViewerScene, body_poses: NDArray[np.float64]) -> Extent:
    """Bound the followed body's model, or everything of moderate size where none is followed."""
    bodies = scene.scene.bodies
    kin = None if scene.follow_body is None else bodies[scene.follow_body].rpartition("::")[0] + "::"
    shapes = [s for s in scene.scene.shapes if not isinstance(s.geometry, Plane) and _reach(s) < _HUGE_M]
    of_robot = [s for s in shapes if kin is not None and bodies[s.body].startswith(kin)]
    shapes = of_robot or shapes
    if shapes:
        poses = compose_rows(body_poses[[s.body for s in shapes]], rows_from_poses([s.body_from_shape for s in shapes]))
        reach = np.array([[_reach(s)] for s in shapes])
        there = finite_rows(poses)
        if there.any():
            low = (poses[there, :3] - reach[there]).min(axis=0)
            high = (poses[there, :3] + reach[there]).max(axis=0)
            return Extent((low + high) / 2, max(float(np.linalg.norm(high - low)) / 2, 0.05))
    return Extent(np.zeros(3), _GUESS_M, is_guess=True)


def _reach(shape: Shape) -> float:
    """How far a shape goes from its origin at most [m]."""
    match shape.geometry:
        case Box(size=size):
            return math.hypot(*size) / 2
        case Cylinder(radius=r, length=length):
            return math.hypot(r, length / 2)
        case Capsule(radius=r, length=length):
            return r + length / 2
        case Sphere(radius=r):
            return r
        case Ellipsoid(radii=radii):
            return max(radii)
        case Plane(size=size):
            return math.hypot(*size) / 2
        case Mesh(vertices=vertices):
            return float(np.linalg.norm(vertices, axis=1).max()) if len(vertices) else 0.0
