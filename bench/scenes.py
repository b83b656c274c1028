"""Scenes of the renderer benchmarks: ten primitives (A, C), twenty meshes of 5,000 triangles (B)."""

import math
from pathlib import Path

import numpy as np
import trimesh
from msgspec.structs import replace
from PIL import Image

from trundle.robots.meshes import Mesh
from trundle.robots.model import Box, Capsule, Cylinder, Ellipsoid, Plane, Sphere
from trundle.sim.render import Intrinsics, Scene, SceneLight, Shape, ShapeGeometry
from trundle.spatial import Pose

SUN = SceneLight(direction=(0.48, -0.36, -0.8), diffuse=(0.6, 0.6, 0.6, 1.0))
GROUND = Shape(name="ground", body=0, geometry=Plane((0.0, 0.0, 1.0), (0.0, 0.0)), rgba=(0.6, 0.6, 0.5, 1.0))
SMALL = Intrinsics(width_px=160, height_px=120, horizontal_fov_rad=1.047)
MIDDLE = Intrinsics(width_px=320, height_px=240, horizontal_fov_rad=1.047)
LARGE = Intrinsics(width_px=640, height_px=480, horizontal_fov_rad=1.047)
EYE = Pose.from_rpy(-4.0, 0.4, 2.0, 0.0, 0.35, -0.1)
FOUR = tuple(
    Pose.from_rpy(-4.0 * math.cos(turn), -4.0 * math.sin(turn), 2.0, 0.0, 0.35, turn)
    for turn in (0.0, 1.57, 3.14, 4.71)
)
_SOLIDS: tuple[ShapeGeometry, ...] = (
    Box((0.5, 0.6, 0.7)),
    Sphere(0.4),
    Cylinder(0.25, 0.9),
    Capsule(0.15, 0.5),
    Ellipsoid((0.5, 0.2, 0.3)),
)


def primitives() -> Scene:
    """Return a plane, a sun and ten primitives, each on its own body."""
    shapes = tuple(
        Shape(name=str(i), body=i + 1, geometry=_SOLIDS[i % 5], rgba=(0.2 + 0.07 * i, 0.9 - 0.08 * i, 0.5, 1.0))
        for i in range(10)
    )
    return _scene((GROUND, *shapes))


def meshes(folder: Path) -> Scene:
    """Return twenty balls of 5,120 triangles with a texture of 512 by 512 pixels."""
    board = (np.indices((512, 512)) // 32).sum(axis=0) % 2 * 120 + 100
    texture = folder / "board.png"
    Image.fromarray(board.astype(np.uint8)).save(texture)
    ball = trimesh.creation.icosphere(subdivisions=4, radius=0.45)
    uv = np.stack([np.arctan2(ball.vertices[:, 1], ball.vertices[:, 0]) / math.tau, ball.vertices[:, 2]], axis=-1)
    mesh = Mesh(ball.vertices.astype(np.float32), ball.faces.astype(np.int32), uv=uv.astype(np.float32)[ball.faces])
    shapes = (
        Shape(name=str(i), body=i + 1, geometry=mesh, rgba=(0.8, 0.7, 0.6, 1.0), texture=texture) for i in range(20)
    )
    return _scene((GROUND, *shapes))


def _scene(shapes: tuple[Shape, ...]) -> Scene:
    return Scene(bodies=tuple(map(str, range(len(shapes)))), shapes=shapes, lights=(SUN,), ambient=(0.3, 0.3, 0.3, 1.0))


def with_shadows(scene: Scene) -> Scene:
    """Return the scene with lights that cast shadows."""
    return replace(scene, lights=tuple(replace(light, casts_shadows=True) for light in scene.lights))


def poses_at(scene: Scene, frame: int) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    """Return (bodies, 7) poses on a ring that rotates with each frame; body 0 does not move."""
    count = len(scene.bodies)
    poses = np.zeros((count, 7))
    poses[:, 3] = 1.0
    turn = math.tau * np.arange(count - 1) / (count - 1) + 0.01 * frame
    poses[1:, 0], poses[1:, 1], poses[1:, 2] = 1.6 * np.cos(turn), 1.6 * np.sin(turn), 0.5
    return poses
