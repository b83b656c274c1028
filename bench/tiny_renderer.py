"""PyBullet's TinyRenderer with the interface of Trundle's renderers, if PyBullet is installed."""

import math
from collections.abc import Sequence
from importlib import import_module
from typing import Any

import numpy as np
import trimesh
from numpy.typing import NDArray

from trundle.robots.meshes import Mesh
from trundle.robots.model import Box, Capsule, Cylinder, Ellipsoid, Sphere
from trundle.sim.render import Intrinsics, Scene, Shape
from trundle.spatial import Pose

_GROUND_M = 20.0
"""Half size of a plane; TinyRenderer draws triangles only [m]."""


class TinyRenderer:
    """Draws a bench scene in its colors, without textures."""

    def __init__(self, scene: Scene) -> None:
        """Create the scene in PyBullet.

        Raises:
            ImportError: PyBullet is not installed.
        """
        self._bullet: Any = import_module("pybullet")
        self._client = self._bullet.connect(self._bullet.DIRECT)
        self._shadow = int(any(light.casts_shadows for light in scene.lights))
        self._light = [-number for number in scene.lights[0].direction]
        self._bodies = [(shape.body, self._body(shape)) for shape in scene.shapes]

    def update(self, poses: NDArray[np.float64]) -> None:
        """Set the poses."""
        for body, number in self._bodies:
            x, y, z, qw, qx, qy, qz = poses[body].tolist()
            self._bullet.resetBasePositionAndOrientation(
                number, (x, y, z), (qx, qy, qz, qw), physicsClientId=self._client
            )

    def render(self, views: Sequence[tuple[Pose, Intrinsics]]) -> None:
        """Render the cameras' images."""
        bullet = self._bullet
        for eye, lens in views:
            ahead, up = eye.transform_vector((1.0, 0.0, 0.0)), eye.transform_vector((0.0, 0.0, 1.0))
            target = [a + b for a, b in zip(eye.position, ahead, strict=True)]
            height_rad = 2 * math.atan(lens.height_px / 2 / lens.focal_px)
            bullet.getCameraImage(
                lens.width_px,
                lens.height_px,
                bullet.computeViewMatrix(eye.position, target, up),
                bullet.computeProjectionMatrixFOV(math.degrees(height_rad), lens.width_px / lens.height_px, 0.1, 100.0),
                lightDirection=self._light,
                shadow=self._shadow,
                renderer=bullet.ER_TINY_RENDERER,
                physicsClientId=self._client,
            )

    def close(self) -> None:
        """Disconnect from PyBullet."""
        self._bullet.disconnect(self._client)

    def _body(self, shape: Shape) -> int:
        bullet = self._bullet
        visual = bullet.createVisualShape(
            **self._visual_shape(shape), rgbaColor=shape.rgba, physicsClientId=self._client
        )
        return bullet.createMultiBody(baseVisualShapeIndex=visual, physicsClientId=self._client)

    def _visual_shape(self, shape: Shape) -> dict[str, object]:
        bullet = self._bullet
        match shape.geometry:
            case Box((x, y, z)):
                return {"shapeType": bullet.GEOM_BOX, "halfExtents": (x / 2, y / 2, z / 2)}
            case Sphere(radius):
                return {"shapeType": bullet.GEOM_SPHERE, "radius": radius}
            case Cylinder(radius, length):
                return {"shapeType": bullet.GEOM_CYLINDER, "radius": radius, "length": length}
            case Capsule(radius, length):
                return {"shapeType": bullet.GEOM_CAPSULE, "radius": radius, "length": length}
            case Ellipsoid(radii):
                ball = trimesh.creation.icosphere(subdivisions=3)
                return self._mesh(ball.vertices * radii, ball.faces)
            case Mesh(vertices, faces):
                return self._mesh(vertices, faces)
            case _:
                return {"shapeType": bullet.GEOM_BOX, "halfExtents": (_GROUND_M, _GROUND_M, 1e-3)}

    def _mesh(self, vertices: NDArray[Any], faces: NDArray[Any]) -> dict[str, object]:
        return {
            "shapeType": self._bullet.GEOM_MESH,
            "vertices": vertices.tolist(),
            "indices": faces.reshape(-1).tolist(),
        }
